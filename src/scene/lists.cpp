#include "scene/lists.h"

#include <algorithm>
#include <array>

#include "ot/gp0.h"

namespace scene {
namespace {

constexpr std::uint32_t environment_address = 0x10000;
constexpr std::uint32_t table_begin = environment_address + 64;

std::uint32_t node_bytes(std::size_t words) { return static_cast<std::uint32_t>(4 + 4 * words); }

}  // namespace

std::int64_t BucketRule::wanted(const Primitive& p) const {
  return (std::int64_t{p.otz} * length >> 16) + bias + p.material->bias * bias_step;
}

std::uint32_t BucketRule::limited(std::int64_t wanted) const {
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(wanted, 0, length - 1));
}

std::size_t encode(const Primitive& p, const PacketStyle& style, std::span<std::uint32_t> out) {
  std::size_t n = 0;
  const PacketMaterial& m = *p.material;
  if (m.texture != nullptr && style.windows) out[n++] = m.texture->window;
  if (m.texture == nullptr && m.semi_transparent) out[n++] = style.draw_mode | m.texpage;
  if (p.count == 2) return n + ot::encode(line_of(p), out.subspan(n));
  return n + ot::encode(polygon_of(p), out.subspan(n));
}

std::size_t encode_annotation(const Primitive& p, const PacketStyle& style, std::span<std::uint32_t> out) {
  if (p.count == 2) return 0;
  const auto rests = [&p] {
    return std::any_of(p.corner.begin(), p.corner.begin() + static_cast<std::ptrdiff_t>(p.count),
                       [](const Corner& c) { return c.rest.u != 0 || c.rest.v != 0; });
  };
  const bool has_rests = style.texel_rests && p.material->texture != nullptr && rests();
  ot::DepthAnnotation words = depth_of(p, style.fraction_mask, style.fractions || has_rests);
  words.has_depth = style.depth || (style.depth_of_shaded && is_shaded(p));
  if (!words.has_depth && !words.has_fractions) return 0;
  for (std::size_t k = 0; k < p.count && has_rests; ++k) {
    words.du[k] = p.corner[k].rest.u;
    words.dv[k] = p.corner[k].rest.v;
  }
  return ot::encode(words, out);
}

void BucketSizes::add(const Primitive& p, std::uint32_t bucket) {
  std::array<std::uint32_t, 16> words{};
  std::uint32_t bytes = node_bytes(encode(p, style_, words));
  if (const auto n = encode_annotation(p, style_, words); n > 0) bytes += node_bytes(n);
  bytes_[bucket] += bytes;
}

base::Result<std::vector<BucketRange>> BucketSizes::ranges(std::uint32_t available) const {
  std::vector<BucketRange> out;
  std::uint64_t used = 0;
  std::uint32_t last = rule_.length - 1;
  for (std::uint32_t b = rule_.length; b-- > 0;) {
    if (bytes_[b] > available) {
      return base::fail("bucket " + std::to_string(b) + " alone needs " + std::to_string(bytes_[b]) +
                            " bytes of main RAM, " + std::to_string(available) +
                            " are available: use more buckets",
                        base::Exit::failed);
    }
    if (used + bytes_[b] > available) {
      out.push_back({b + 1, last});
      last = b;
      used = 0;
    }
    used += bytes_[b];
  }
  out.push_back({0, last});
  return out;
}

std::uint32_t ListBuilder::room(const ot::MainRam& ram, std::uint32_t table_length) {
  return ram.size_bytes() - table_begin - 4 * table_length;
}

void ListBuilder::begin(ot::MainRam& ram, const Plan& plan, const BucketRange& range,
                        std::span<const std::uint32_t> environment) {
  ram_ = &ram;
  rule_ = plan.rule;
  style_ = plan.style;
  range_ = range;
  sorts_ = plan.sorting != Sorting::table;
  order_ = plan.order_in_bucket;
  full_ = false;
  primitives_ = words_ = 0;
  out_of_range_ = {};
  keyed_.clear();
  if (sorts_) {
    table_.reset();
  } else {
    if (!table_ || table_->memory().data() != ram.words().data() || table_->length() != rule_.length ||
        table_->order() != order_)
      table_.emplace(ram, table_begin, rule_.length, order_);
    table_->clear();
  }
  arena_begin_ = table_begin + 4 * table_length();
  arena_.emplace(ram, arena_begin_, ram.size_bytes());
  ot::PacketArena first(ram, environment_address, table_begin);
  first.push(environment);
}

void ListBuilder::note_out_of_range(std::int64_t wanted) {
  ++(wanted < 0 ? out_of_range_.below : wanted == rule_.length ? out_of_range_.at : out_of_range_.above);
}

bool ListBuilder::add(const Primitive& p, std::uint32_t bucket) {
  if (bucket < range_.first || bucket > range_.last || full_) return false;
  std::array<std::uint32_t, 16> words;
  std::optional<std::uint32_t> note;
  const std::size_t note_words = encode_annotation(p, style_, words);
  if (note_words > 0) {
    note = arena_->push(std::span(words).first(note_words));
    full_ = !note;
  }
  const std::size_t n = encode(p, style_, words);
  const auto node = full_ ? std::nullopt : arena_->push(std::span(words).first(n));
  if (!node) {
    full_ = true;
    return false;
  }
  if (note) ot::link(*ram_, *note, *node);
  ++primitives_;
  words_ += static_cast<std::uint32_t>(note_words + n);
  if (sorts_) {
    keyed_.push_back({bucket, note.value_or(*node), *node});
  } else {
    table_->insert(bucket, note.value_or(*node), *node);
  }
  return true;
}

void ListBuilder::end() {
  constexpr std::uint32_t from = environment_address;
  if (!sorts_) {
    ot::link(*ram_, from, table_->head());
    return;
  }
  // SortedList draws the last inserted of equal keys first.
  if (order_ == ot::Order::fifo) std::reverse(keyed_.begin(), keyed_.end());
  sorted_.clear();
  for (const auto& k : keyed_) sorted_.insert(k.key, k.first_node, k.last_node);
  ot::link(*ram_, from, sorted_.link(ram_->words()));
}

std::uint32_t ListBuilder::head() const { return environment_address; }
std::uint32_t ListBuilder::table_address() const { return table_begin; }
std::uint32_t ListBuilder::ram_bytes() const {
  return arena_begin_ - environment_address + arena_->used_bytes();
}

}  // namespace scene
