#pragma once
// Depth of a program that knows none: what the coprocessor projected is remembered where its screen position
// was stored, and found again when a polygon with that position is sent to the GPU.
//
// In this order:
//   address   every vertex lies where a macro stored it, and the word there is still the same;
//   value     some lie elsewhere (copied), but all their words are positions of the last two lists, each with
//   one
//             depth;
//   packet    vertices were made by arithmetic (billboards): the depth of the vertex projected last before
//   the
//             packet was linked, if that was after the packet linked before it;
//   none.
//
// A packet that is built once and linked for many frames keeps its depth, as it keeps its position.

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "gte/commands.h"
#include "gte/registers.h"
#include "ot/packet.h"

namespace sdk {

enum class DepthSource : std::uint8_t { address, value, packet, none };

/// What a projection makes of a vertex besides its registers: view-space z as 20.12, and bits 8..15 of the
/// screen coordinates.
struct ExactPosition {
  std::uint32_t z = 0;
  std::uint8_t fx = 0, fy = 0;
  bool operator==(const ExactPosition&) const = default;
};
/// As gte::project() has it, faster for one vertex; nothing for the few commands and translations that are
/// left to it: sf = 0, and sums that might leave 44 bits.
std::optional<ExactPosition> exact_position(const gte::Registers& before, const gte::Vertex& vertex,
                                            gte::Command command);

/// How many polygons got their depth from where. `partly`: of those without, some vertices were known.
struct DepthShares {
  std::uint64_t by_address = 0, by_value = 0, by_packet = 0, none = 0, partly = 0;
  std::uint64_t stale = 0;      ///< vertices where something was stored that was overwritten since
  std::uint64_t ambiguous = 0;  ///< words looked for that stood for more than one depth
  [[nodiscard]] std::uint64_t polygons() const { return by_address + by_value + by_packet + none; }
  bool operator==(const DepthShares&) const = default;
};

/// "depth of 120 polygons: 100.0 % by address, ...".
std::string to_text(const DepthShares& shares);

class DepthNotes {
 public:
  /// Nothing is noted, and nothing is paid, before this.
  void start();
  [[nodiscard]] bool is_on() const { return places_ != nullptr; }

  /// RTPS or RTPT is about to run on `before`; any other command does nothing.
  void project(const gte::Registers& before, gte::Command command);
  /// A register was written: a screen position that no projection made has no depth. `pushes`: SXYP.
  void write_position(unsigned number);
  /// SXY `number`, which is `word`, was stored at `address` (bytes; any, what lies above 8 MiB counts by
  /// value).
  void store(std::uintptr_t address, std::uint32_t word, unsigned number);
  /// A packet whose tag lies at `address` was linked.
  void link(std::uint32_t address);

  /// The depth of the polygon `words`, whose first word lies at `address`; nothing: none is known.
  std::optional<ot::DepthAnnotation> find(std::span<const std::uint32_t> words, std::uint32_t address);
  /// A list has been drawn: values older than two lists are forgotten.
  void next_list();

  [[nodiscard]] const DepthShares& shares() const { return shares_; }

 private:
  struct Depth {
    std::uint32_t z = 0;
    std::uint8_t fx = 0, fy = 0;
    bool is_known = false;
    bool operator==(const Depth&) const = default;
  };
  struct Place {  // of one word of memory
    std::uint32_t word;
    Depth depth;
    bool is_link;  // a tag: the depth is what the packet was linked with
  };
  struct Value {
    Depth depth;
    bool is_ambiguous = false, is_counted = false;  ///< in DepthShares::ambiguous
  };
  /// The positions of a list and their depths. Few programs ask for them by value, so they are put in order
  /// only then.
  class Values {
   public:
    void add(std::uint32_t word, const Depth& depth) { added_.push_back({word, depth}); }
    [[nodiscard]] Value* find(std::uint32_t word);
    void clear();

   private:
    void index();
    struct Added {
      std::uint32_t word;
      Depth depth;
    };
    std::vector<Added> added_;
    std::size_t indexed_ = 0;
    std::unordered_map<std::uint32_t, Value> by_word_;
  };
  struct Free {
    void operator()(Place* p) const { std::free(p); }
  };

  [[nodiscard]] const Depth* by_value(std::uint32_t word);

  std::array<Depth, 3> fifo_{};  // beside SXY0..2
  bool is_fresh_ = false;        // a vertex was projected after the packet linked last
  std::unique_ptr<Place[], Free> places_;
  Values values_, older_values_;
  DepthShares shares_;
};

}  // namespace sdk
