#include "debug/item_cutter.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "ot/gp1.h"

namespace debug {

void ItemCutter::set_node(std::uint32_t address, std::uint32_t bucket, std::string origin) {
  address_ = address;
  bucket_ = bucket;
  origin_ = std::move(origin);
}

void ItemCutter::rest(std::span<const std::uint32_t> words, bool counts) {
  if (items_.empty() || !items_.back().is_rest) {
    const bool is_first = std::none_of(items_.begin(), items_.end(), [](const auto& i) { return i.is_rest; });
    items_.push_back({.number = counts && is_first ? ++count_ : 0, .is_rest = true});
  }
  auto& all = items_.back().words;
  all.insert(all.end(), words.begin(), words.end());
}

void ItemCutter::gp0(std::span<const std::uint32_t> words) {
  for (std::size_t n = 0; n < words.size(); ++n) {
    if (const auto pixels = stream_.skip_pixels(words.size() - n); pixels != 0) {
      const auto from = words.begin() + static_cast<std::ptrdiff_t>(n);
      now_.words.insert(now_.words.end(), from, from + static_cast<std::ptrdiff_t>(pixels));
      n += pixels;
      if (n == words.size()) return;
    }
    take(words[n]);
  }
}

void ItemCutter::gp1(std::uint32_t word) {
  cut();
  if (ot::gp1::aborts_command(word)) {
    stream_.abort();
    now_ = {};
  }
  Item item{.number = ++count_, .is_control = true};
  item.words = {word};
  items_.push_back(std::move(item));
}

void ItemCutter::take(std::uint32_t word) {
  if (now_.words.empty() && !now_.is_rest) {
    now_.address = address_;
    now_.bucket = bucket_;
    now_.origin = origin_;
  }
  now_.words.push_back(word);
  const bool is_whole = stream_.take(word);
  if (stream_.command() == ot::gp0::Command::annotation) return;
  if (begins(is_whole)) now_.number = ++count_;
  if (!is_whole) return;
  items_.push_back(std::exchange(now_, {}));
}

// When the GPU begins to obey: an upload when its size is known, a polyline with its first segment.
bool ItemCutter::begins(bool is_whole) const {
  if (stream_.command() == ot::gp0::Command::upload) return stream_.length() == 3;
  if (stream_.command() == ot::gp0::Command::polyline) return stream_.length() == stream_.needed();
  return is_whole;
}

// What there is of the command becomes an item, and the rest of it another one.
void ItemCutter::cut() {
  if (now_.words.empty()) return;
  Item rest{.number = now_.number, .is_rest = true, .bucket = now_.bucket, .address = now_.address};
  rest.origin = now_.origin;
  items_.push_back(std::exchange(now_, std::move(rest)));
}

}  // namespace debug
