// Any bytes as a frame of a running program: what is taken for one travels on unchanged.

#include "door/live.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto frame = door::live_frame_of(std::as_bytes(std::span(data, size)));
  if (!frame) return 0;
  const auto again = door::live_frame_of(door::to_bytes(*frame));
  if (!again || again->number != frame->number || again->state != frame->state ||
      again->words != frame->words || again->lint != frame->lint || again->runs.size() != frame->runs.size())
    std::abort();
  std::size_t words = 0;
  for (const auto& run : frame->runs) words += run.words;
  if (words != frame->words.size()) std::abort();
  return 0;
}
