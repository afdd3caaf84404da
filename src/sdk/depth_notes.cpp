#include "sdk/depth_notes.h"

#include <new>

#include "base/printed.h"
#include "gte/batch.h"
#include "ot/gp0.h"
#include "sdk/memory.h"

namespace sdk {
namespace {

constexpr unsigned rtps = 0x01, rtpt = 0x30;  // opcodes

}  // namespace

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
  std::array<std::uint32_t, 3> z{};
  std::array<std::uint8_t, 3> fx{}, fy{};
  gte::ProjectOut out;
  out.z_20_12 = z.data();
  out.fraction_x = fx.data();
  out.fraction_y = fy.data();
  gte::project(before, std::span(before.v).first(count), out, command);
  for (std::size_t i = 0; i < count; ++i) fifo_ = {fifo_[1], fifo_[2], Depth{z[i], fx[i], fy[i], true}};
  is_fresh_ = true;
}

void DepthNotes::write_position(unsigned number) {
  if (number == 15) fifo_ = {fifo_[1], fifo_[2], Depth{}};
  if (number >= 12 && number < 15) fifo_[number - 12] = {};
}

void DepthNotes::store(std::uintptr_t address, std::uint32_t word, unsigned number) {
  if (!is_on() || !fifo_[number].is_known) return;
  const Depth& depth = fifo_[number];
  if (address < memory_end && address % 4 == 0) places_[address / 4] = {word, depth, false};
  const auto [at, is_new] = values_.try_emplace(word, Value{depth});
  if (!is_new && at->second.depth != depth && !at->second.is_ambiguous) {
    at->second.is_ambiguous = true;
    ++shares_.ambiguous;
  }
}

void DepthNotes::link(std::uint32_t address) {
  if (!is_on() || address >= memory_end) return;
  places_[address / 4] = {0, is_fresh_ ? fifo_[2] : Depth{}, true};
  is_fresh_ = false;
}

const DepthNotes::Depth* DepthNotes::by_value(std::uint32_t word) const {
  for (const auto* values : {&values_, &older_values_}) {
    const auto at = values->find(word);
    if (at != values->end()) return at->second.is_ambiguous ? nullptr : &at->second.depth;
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
  older_values_ = std::move(values_);
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
