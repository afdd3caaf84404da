#pragma once
// The graph of "must be drawn before", and what stands in its way: its strongly connected components are the
// cycles no painter's order can draw.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace exact {

/// first must be drawn before second.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Strongly connected components of the nodes 0 .. node_count-1, each in ascending order of its
/// nodes. They come in a drawing order: of two components joined by an edge, the one that must be
/// drawn first comes first. Linear in nodes and edges, no recursion [Tarjan 1972]. Edges may
/// repeat; both ends are below node_count.
std::vector<std::vector<std::uint32_t>> components_in_order(std::uint32_t node_count,
                                                            std::span<const Edge> edges);

}  // namespace exact
