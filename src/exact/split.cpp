#include "exact/split.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <optional>
#include <unordered_set>
#include <utility>

#include "exact/order_graph.h"

namespace exact {
namespace {

// The total order at a pixel: farther first, then lower index.
class Depths {
 public:
  explicit Depths(std::span<const Triangle> triangles) : planes_(triangles.begin(), triangles.end()) {}

  [[nodiscard]] bool is_before(std::uint32_t a, std::uint32_t b, int x, int y) {
    const auto nearness = compare_nearness(planes_[a], planes_[b], x, y, counts);
    return nearness == 0 ? a < b : nearness < 0;
  }
  [[nodiscard]] bool has_plane(std::uint32_t triangle) const { return !planes_[triangle].is_degenerate(); }
  /// One triangle, drawn twice: the index decides everywhere.
  [[nodiscard]] bool are_same(std::uint32_t a, std::uint32_t b) const {
    return planes_[a].has_corners_of(planes_[b]);
  }

  [[nodiscard]] double nearness(std::uint32_t triangle, int x, int y) const {
    return planes_[triangle].estimate(x, y).value;
  }

  DecisionCounts counts;

 private:
  std::vector<InversePlane> planes_;
};

// Finds the edges between neighbours in depth at every pixel; by transitivity they stand for all pairs.
class EdgeFinder {
 public:
  EdgeFinder(std::span<const Piece> pieces, Depths& depths) : pieces_(pieces), depths_(depths) {}

  /// Nothing if `keep_going` says so.
  std::optional<std::vector<Edge>> find(const std::function<bool()>& keep_going) {
    int top = 0, bottom = 0;
    for (const Piece& piece : pieces_) {
      top = std::min(top, piece.rows.top);
      bottom = std::max(bottom, piece.rows.bottom());
    }
    std::vector<std::vector<std::uint32_t>> starting(static_cast<std::size_t>(bottom - top));
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
      if (!pieces_[p].rows.spans.empty()) {
        starting[static_cast<std::size_t>(pieces_[p].rows.top - top)].push_back(p);
      }
    }
    std::vector<std::uint32_t> live;
    for (int y = top; y < bottom; ++y) {
      if (!keep_going()) return std::nullopt;
      const auto& fresh = starting[static_cast<std::size_t>(y - top)];
      std::erase_if(live, [&](std::uint32_t p) { return pieces_[p].rows.bottom() <= y; });
      live.insert(live.end(), fresh.begin(), fresh.end());
      row(live, y);
    }
    return std::move(edges_);
  }

 private:
  // Between two ends of spans the set of pieces is constant.
  void row(const std::vector<std::uint32_t>& live, int y) {
    ends_.clear();
    by_left_.clear();
    for (const std::uint32_t p : live) {
      const Columns span = pieces_[p].rows.at(y);
      if (span.is_empty()) continue;
      ends_.push_back(span.left);
      ends_.push_back(span.right);
      by_left_.push_back(p);
    }
    std::sort(ends_.begin(), ends_.end());
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    std::sort(by_left_.begin(), by_left_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return pieces_[a].rows.at(y).left < pieces_[b].rows.at(y).left;
    });
    stack_.clear();
    std::size_t next = 0;
    for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
      const Columns part{ends_[i], ends_[i + 1]};
      std::erase_if(stack_, [&](std::uint32_t p) { return pieces_[p].rows.at(y).right <= part.left; });
      for (; next < by_left_.size() && pieces_[by_left_[next]].rows.at(y).left == part.left; ++next) {
        stack_.push_back(by_left_[next]);
      }
      if (stack_.size() > 1) interval(part, y);
    }
  }

  // 1/z is affine along the row: neighbours in the same order at both ends are in that order between them.
  void interval(Columns part, int y) {
    sort_at(part.left, y);
    note_neighbours();
    if (part.right - part.left == 1 || is_sorted_at(part.right - 1, y)) return;
    const int middle = part.left + (part.right - part.left) / 2;
    if (middle > part.left + 1) interval({part.left + 1, middle}, y);
    interval({middle, part.right}, y);
  }

  [[nodiscard]] bool before(std::uint32_t a, std::uint32_t b, int x, int y) {
    return depths_.is_before(pieces_[a].triangle, pieces_[b].triangle, x, y);
  }

  // Insertion: the order of the pixel before is nearly always right already.
  void sort_at(int x, int y) {
    for (std::size_t i = 1; i < stack_.size(); ++i) {
      for (std::size_t k = i; k > 0 && before(stack_[k], stack_[k - 1], x, y); --k)
        std::swap(stack_[k], stack_[k - 1]);
    }
  }

  [[nodiscard]] bool is_sorted_at(int x, int y) {
    for (std::size_t i = 1; i < stack_.size(); ++i) {
      if (before(stack_[i], stack_[i - 1], x, y)) return false;
    }
    return true;
  }

  void note_neighbours() {
    for (std::size_t i = 1; i < stack_.size(); ++i) {
      if (seen_.insert(std::uint64_t{stack_[i - 1]} << 32 | stack_[i]).second) {
        edges_.emplace_back(stack_[i - 1], stack_[i]);
      }
    }
  }

  std::span<const Piece> pieces_;
  Depths& depths_;
  std::vector<Edge> edges_;
  std::unordered_set<std::uint64_t> seen_;
  std::vector<std::int32_t> ends_;
  std::vector<std::uint32_t> by_left_, stack_;
};

enum class Side : std::uint8_t { behind, in_front, both };

class Splitter {
 public:
  Splitter(std::span<const Triangle> triangles, const Area& area, const SplitLimits& limits)
      : depths_(triangles), limits_(limits) {
    std::vector<Piece> all;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (!depths_.has_plane(t)) continue;
      Piece piece{t, true, covered_rows(triangles[t], area)};
      if (!piece.rows.spans.empty()) all.push_back(std::move(piece));
    }
    for (const Piece& piece : all) spans_ += piece.rows.spans.size();
    known_ = all.size();
    work_.push_back({std::move(all), false});
  }

  SplitOrder run() && {
    while (!work_.empty()) {
      Set set = std::move(work_.back());
      work_.pop_back();
      if (!goes_on()) by_one_depth(set.pieces);
      if (set.is_ordered || set.pieces.size() == 1 || is_over()) {
        for (Piece& piece : set.pieces) result_.pieces.push_back(std::move(piece));
      } else if (set.is_cycle) {
        divide(std::move(set.pieces));
      } else {
        order(std::move(set.pieces));
      }
    }
    result_.decisions = depths_.counts;
    return std::move(result_);
  }

 private:
  struct Set {
    std::vector<Piece> pieces;
    bool is_ordered = false, is_cycle = false;
  };

  [[nodiscard]] bool is_over() const { return result_.was_stopped || result_.was_too_much; }
  bool goes_on() {
    if (is_over()) return false;
    result_.was_too_much = spans_ > limits_.most_spans;
    const auto done =
        static_cast<double>(result_.pieces.size()) / static_cast<double>(std::max<std::size_t>(known_, 1));
    result_.was_stopped = limits_.keep_going && !limits_.keep_going(done);
    return !is_over();
  }
  // Far to near by the depth in the middle of the first row.
  void by_one_depth(std::vector<Piece>& pieces) {
    const auto nearness = [&](const Piece& p) {
      if (p.rows.spans.empty()) return 0.0;
      return depths_.nearness(p.triangle, (p.rows.spans[0].left + p.rows.spans[0].right) / 2, p.rows.top);
    };
    std::stable_sort(pieces.begin(), pieces.end(),
                     [&](const Piece& a, const Piece& b) { return nearness(a) < nearness(b); });
  }

  // The last pushed is drawn first.
  void order(std::vector<Piece> pieces) {
    const auto edges = EdgeFinder(pieces, depths_).find([this] { return goes_on(); });
    if (!edges) {
      work_.push_back({std::move(pieces), true});
      return;
    }
    const auto components = components_in_order(static_cast<std::uint32_t>(pieces.size()), *edges);
    for (auto component = components.rbegin(); component != components.rend(); ++component) {
      Set set;
      for (const std::uint32_t p : *component) set.pieces.push_back(std::move(pieces[p]));
      set.is_cycle = component->size() > 1;
      set.is_ordered = !set.is_cycle;
      if (set.is_cycle) ++result_.cycles;
      work_.push_back(std::move(set));
    }
  }

  void divide(std::vector<Piece> pieces) {
    const std::size_t chosen = choose(pieces);
    Piece divider = std::move(pieces[chosen]);
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(chosen));
    Set behind, in_front;
    for (Piece& piece : pieces) {
      switch (side(piece, divider.triangle)) {
        case Side::behind:
          behind.pieces.push_back(std::move(piece));
          break;
        case Side::in_front:
          in_front.pieces.push_back(std::move(piece));
          break;
        case Side::both:
          auto [far, near] = cut(piece, divider.triangle);
          behind.pieces.push_back(std::move(far));
          in_front.pieces.push_back(std::move(near));
          ++result_.splits;
          ++known_;
          spans_ += behind.pieces.back().rows.spans.size() + in_front.pieces.back().rows.spans.size();
      }
    }
    work_.push_back(std::move(in_front));
    Set middle;
    middle.pieces.push_back(std::move(divider));
    middle.is_ordered = true;
    work_.push_back(std::move(middle));
    work_.push_back(std::move(behind));
  }

  // The piece whose plane cuts the fewest others, of at most 24 candidates spread evenly.
  std::size_t choose(const std::vector<Piece>& pieces) {
    const std::size_t step = (pieces.size() + 23) / 24;
    std::size_t best = 0, fewest = pieces.size();
    for (std::size_t candidate = 0; candidate < pieces.size() && fewest > 0; candidate += step) {
      std::size_t cuts = 0;
      for (std::size_t p = 0; p < pieces.size() && cuts < fewest; ++p) {
        if (p != candidate && side(pieces[p], pieces[candidate].triangle) == Side::both) ++cuts;
      }
      if (cuts < fewest) {
        best = candidate;
        fewest = cuts;
      }
    }
    return best;
  }

  // Affine functions take their extremes at the ends of rows.
  Side side(const Piece& piece, std::uint32_t divider) {
    if (piece.triangle == divider) return Side::behind;
    if (depths_.are_same(piece.triangle, divider)) {
      return piece.triangle < divider ? Side::behind : Side::in_front;
    }
    bool behind = false, in_front = false;
    for (int y = piece.rows.top; y < piece.rows.bottom(); ++y) {
      const Columns span = piece.rows.at(y);
      if (span.is_empty()) continue;
      for (const int x : {span.left, span.right - 1}) {
        (depths_.is_before(piece.triangle, divider, x, y) ? behind : in_front) = true;
      }
      if (behind && in_front) return Side::both;
    }
    return behind ? Side::behind : Side::in_front;
  }

  // Behind the divider's plane, and in front of it.
  std::pair<Piece, Piece> cut(const Piece& piece, std::uint32_t divider) {
    Piece far{piece.triangle, false, {piece.rows.top, {}}}, near = far;
    for (int y = piece.rows.top; y < piece.rows.bottom(); ++y) {
      const Columns span = piece.rows.at(y);
      if (span.is_empty()) {
        far.rows.spans.emplace_back();
        near.rows.spans.emplace_back();
        continue;
      }
      const auto is_behind = [&](int x) { return depths_.is_before(piece.triangle, divider, x, y); };
      const bool left_is_behind = is_behind(span.left);
      int same = span.left,
          other = span.right;  // the last pixel known to be as the left one, the first not to be
      while (other - same > 1) {
        const int middle = same + (other - same) / 2;
        (is_behind(middle) == left_is_behind ? same : other) = middle;
      }
      const Columns left{span.left, other},
          right = other < span.right ? Columns{other, span.right} : Columns{};
      far.rows.spans.push_back(left_is_behind ? left : right);
      near.rows.spans.push_back(left_is_behind ? right : left);
    }
    trim(far.rows);
    trim(near.rows);
    return {std::move(far), std::move(near)};
  }

  Depths depths_;
  const SplitLimits& limits_;
  std::size_t known_ = 0, spans_ = 0;  // pieces, and their spans
  std::vector<Set> work_;              // the last is drawn first
  SplitOrder result_;
};

}  // namespace

SplitOrder split_into_order(std::span<const Triangle> triangles, const Area& area,
                            const SplitLimits& limits) {
  return Splitter(triangles, area, limits).run();
}

}  // namespace exact
