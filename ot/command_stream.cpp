#include "ot/command_stream.h"

#include <algorithm>

namespace ot {

bool CommandStream::take(std::uint32_t word) {
  if (!open_) {
    open_ = true;
    command_ = gp0::command_of(word);
    needed_ = gp0::command_words(word);
    length_ = 0;
    words_.clear();
  }
  const bool is_pixel = command_ == gp0::Command::upload && length_ >= 3;
  if (!is_pixel && words_.size() < kept_words) words_.push_back(word);
  ++length_;

  if (command_ == gp0::Command::polyline) {
    // The first segment is always taken; from then on each vertex begins with the word that may end the line.
    const auto tail = length_ - 1;
    const bool begins_vertex =
        tail >= needed_ && (gp0::line::IsGouraud::get(words_[0]) == 0 || (tail - needed_) % 2 == 0);
    open_ = !(begins_vertex && gp0::line::is_terminator(word));
    return !open_;
  }
  if (command_ == gp0::Command::upload && length_ == 3) needed_ += gp0::transfer::data_words(word);
  open_ = length_ < needed_;
  return !open_;
}

std::size_t CommandStream::skip_pixels(std::size_t available) {
  if (!open_ || command_ != gp0::Command::upload || length_ < 3) return 0;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(available, needed_ - length_ - 1));
  length_ += count;
  return count;
}

}  // namespace ot
