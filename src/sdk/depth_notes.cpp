#include "sdk/depth_notes.h"

#include <algorithm>
#include <new>
#include <utility>

#include "base/printed.h"
#include "gte/batch.h"
#include "gte/divide.h"
#include "ot/gp0.h"
#include "sdk/memory.h"

namespace sdk {
namespace {

constexpr unsigned rtps = 0x01, rtpt = 0x30;  // opcodes

}  // namespace

std::optional<ExactPosition> exact_position(const gte::Registers& before, const gte::Vertex& vertex,
                                            gte::Command command) {
  // Below it no sum of three products of 16 bits can leave 44 bits.
  constexpr std::int64_t small_translation = (std::int64_t{1} << 31) - (std::int64_t{1} << 20);
  if (!command.sf()) return std::nullopt;
  std::array<std::int64_t, 3> sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t translation = before.tr[i];
    if (std::abs(translation) >= small_translation) return std::nullopt;
    const auto& row = before.rt[i];
    sum[i] = translation * 4096 + std::int64_t{row[0].raw} * vertex.x + std::int64_t{row[1].raw} * vertex.y +
             std::int64_t{row[2].raw} * vertex.z;
  }
  const auto sz3 = static_cast<std::uint16_t>(std::clamp<std::int64_t>(sum[2] >> 12, 0, 0xffff));
  const std::int64_t quotient = gte::divide(before.h, sz3).value;
  const auto fraction = [&](std::int32_t offset, std::int64_t coordinate) {
    const auto ir = std::clamp<std::int64_t>(coordinate >> 12, command.lowest_ir(), 0x7fff);
    return static_cast<std::uint8_t>((offset + quotient * ir) >> 8 & 0xff);
  };
  return ExactPosition{static_cast<std::uint32_t>(std::clamp<std::int64_t>(sum[2], 0, 0xffffffff)),
                       fraction(before.ofx.raw, sum[0]), fraction(before.ofy.raw, sum[1])};
}

void DepthNotes::start() {
  if (is_on()) return;
  // calloc: the system gives zeroed pages when they are touched, a few of 24 MiB.
  places_.reset(static_cast<Place*>(std::calloc(memory_end / 4, sizeof(Place))));
  if (!places_) throw std::bad_alloc();
}

void DepthNotes::project(const gte::Registers& before, gte::Command command) {
  if (!is_on()) return;
  const auto opcode = command.opcode();
  if (opcode != rtps && opcode != rtpt) return;
  const std::size_t count = opcode == rtps ? 1 : 3;
  is_fresh_ = true;
  std::size_t quick = 0;
  for (; quick < count; ++quick) {
    const auto exact = exact_position(before, before.v[quick], command);
    if (!exact) break;
    fifo_ = {fifo_[1], fifo_[2], Depth{exact->z, exact->fx, exact->fy, true}};
  }
  if (quick == count) return;
  std::array<std::uint32_t, 3> z{};
  std::array<std::uint8_t, 3> fx{}, fy{};
  gte::ProjectOut out;
  out.z_20_12 = z.data();
  out.fraction_x = fx.data();
  out.fraction_y = fy.data();
  gte::project(before, std::span(before.v).first(count), out, command);
  for (std::size_t i = quick; i < count; ++i) fifo_ = {fifo_[1], fifo_[2], Depth{z[i], fx[i], fy[i], true}};
}

void DepthNotes::write_position(unsigned number) {
  if (number == 15) fifo_ = {fifo_[1], fifo_[2], Depth{}};
  if (number >= 12 && number < 15) fifo_[number - 12] = {};
}

void DepthNotes::store(std::uintptr_t address, std::uint32_t word, unsigned number) {
  if (!is_on() || !fifo_[number].is_known) return;
  const Depth& depth = fifo_[number];
  if (address < memory_end && address % 4 == 0) places_[address / 4] = {word, depth, false};
  values_.add(word, depth);
}

void DepthNotes::Values::index() {
  for (; indexed_ < added_.size(); ++indexed_) {
    const auto& one = added_[indexed_];
    const auto [at, is_new] = by_word_.try_emplace(one.word, Value{one.depth});
    if (!is_new && at->second.depth != one.depth) at->second.is_ambiguous = true;
  }
}

DepthNotes::Value* DepthNotes::Values::find(std::uint32_t word) {
  index();
  const auto at = by_word_.find(word);
  return at == by_word_.end() ? nullptr : &at->second;
}

void DepthNotes::Values::clear() {
  added_.clear();
  by_word_.clear();
  indexed_ = 0;
}

void DepthNotes::link(std::uint32_t address) {
  if (!is_on() || address >= memory_end) return;
  places_[address / 4] = {0, is_fresh_ ? fifo_[2] : Depth{}, true};
  is_fresh_ = false;
}

const DepthNotes::Depth* DepthNotes::by_value(std::uint32_t word) {
  for (auto* values : {&values_, &older_values_}) {
    auto* value = values->find(word);
    if (value == nullptr) continue;
    if (!value->is_ambiguous) return &value->depth;
    if (!std::exchange(value->is_counted, true)) ++shares_.ambiguous;
    return nullptr;
  }
  return nullptr;
}

std::optional<ot::DepthAnnotation> DepthNotes::find(std::span<const std::uint32_t> words,
                                                    std::uint32_t address) {
  namespace polygon = ot::gp0::polygon;
  if (!is_on()) return std::nullopt;
  const auto count = polygon::vertices(words[0]);
  const std::size_t step = 1 + polygon::IsTextured::get(words[0]) + polygon::IsGouraud::get(words[0]);
  ot::DepthAnnotation found;
  found.count = static_cast<int>(count);
  found.has_fractions = true;
  std::size_t at_address = 0, at_value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = 1 + i * step;
    const std::uint32_t word = words[index], at = address + 4 * static_cast<std::uint32_t>(index);
    const Depth* depth = nullptr;
    if (const auto& place = places_[at % memory_end / 4]; place.depth.is_known && !place.is_link) {
      if (place.word == word) {
        depth = &place.depth;
        ++at_address;
      } else {
        ++shares_.stale;
      }
    }
    if (depth == nullptr && (depth = by_value(word)) != nullptr) ++at_value;
    if (depth == nullptr) continue;
    found.z[i] = depth->z;
    found.fx[i] = depth->fx;
    found.fy[i] = depth->fy;
  }
  if (at_address + at_value == count) {
    ++(at_value == 0 ? shares_.by_address : shares_.by_value);
    return found;
  }
  const auto& tag = places_[(address - 4) % memory_end / 4];
  if (tag.is_link && tag.depth.is_known) {
    ++shares_.by_packet;
    found.z.fill(tag.depth.z);
    found.has_fractions = false;
    return found;
  }
  ++shares_.none;
  if (at_address + at_value != 0) ++shares_.partly;
  return std::nullopt;
}

void DepthNotes::next_list() {
  if (!is_on()) return;
  std::swap(older_values_, values_);
  values_.clear();
  is_fresh_ = false;
}

std::string to_text(const DepthShares& shares) {
  const auto all = shares.polygons();
  const auto percent = [all](std::uint64_t part) {
    return base::printed("%.1f %%",
                         all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all));
  };
  return "depth of " + std::to_string(all) + " polygons: " + percent(shares.by_address) + " by address, " +
         percent(shares.by_value) + " by value, " + percent(shares.by_packet) + " by packet, " +
         percent(shares.none) + " none (" + std::to_string(shares.partly) + " of them partly known)";
}

}  // namespace sdk
