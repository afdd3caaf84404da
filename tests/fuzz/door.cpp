// Any calls of the C library with any arguments: a byte chooses the call, what follows are its arguments.

#include <otter/otter.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace {

struct Input {
  const std::uint8_t* data;
  std::size_t size, at = 0;

  std::uint8_t byte() { return at < size ? data[at++] : 0; }
  std::uint32_t word() {
    std::uint32_t value = 0;
    for (int n = 0; n < 4; ++n) value = value << 8 | byte();
    return value;
  }
  std::string text() {
    std::string text;
    for (std::uint8_t c = byte(); c != 0 && text.size() < 24; c = byte())
      text.push_back(static_cast<char>(c));
    return text;
  }
};

void send_words(otter* gpu, Input& in) {
  std::vector<std::uint32_t> words(in.byte() % 32);
  for (auto& word : words) word = in.word();
  otter_gp0(gpu, words.data(), words.size());
}

void send_list(otter* gpu, Input& in, std::vector<std::uint32_t>& ram) {
  for (int n = in.byte() % 64; n > 0; --n) ram[in.byte() * 4U % ram.size()] = in.word();
  otter_list list;
  const std::uint32_t head = in.word();
  otter_dma_chain(gpu, ram.data(), 4 * ram.size(), head, in.byte() * 16U, &list);
  if (in.byte() % 8 == 0) {
    for (int n = otter_lint(gpu, ram.data(), 4 * ram.size(), head); n-- > 0;) (void)otter_lint_text(gpu, n);
  }
}

void load_damaged(otter* gpu, Input& in) {
  std::vector<std::uint8_t> state(otter_save(gpu, nullptr, 0));
  otter_save(gpu, state.data(), state.size());
  for (int n = in.byte() % 4; n > 0; --n) state[in.word() % 4096] = in.byte();
  otter_load(gpu, state.data(), in.byte() % 8 == 0 ? in.word() % state.size() : state.size());
}

void ask(otter* gpu, Input& in) {
  const int x = static_cast<int>(in.word() % 1100) - 20, y = static_cast<int>(in.word() % 600) - 20;
  otter_draw draw;
  otter_write writes[4];
  otter_pixel_counts counts;
  int width = 0, height = 0;
  otter_last_writer(gpu, x, y, &draw);
  otter_history(gpu, x, y, writes, 4);
  otter_draw_at(gpu, in.byte(), &draw);
  otter_pixels(gpu, &counts);
  otter_picture(gpu, nullptr, 0, &width, &height);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input in{data, size};
  otter* gpu = otter_create();
  std::vector<std::uint32_t> ram(256);
  for (int calls = 0; in.at < size && calls < 200; ++calls) {
    switch (in.byte() % 12) {
      case 0:
      case 1:
      case 2:
        send_words(gpu, in);
        break;
      case 3:
        otter_gp1(gpu, in.word());
        break;
      case 4:
        (void)otter_read(gpu);
        (void)otter_status(gpu);
        break;
      case 5:
        otter_vblank(gpu);
        break;
      case 6:
        send_list(gpu, in, ram);
        break;
      case 7:
        otter_vertex(gpu, in.word(), in.word(), in.word());
        break;
      case 8: {
        const std::string knob = in.text(), value = in.text();
        if (value.size() < 4) otter_set(gpu, knob.c_str(), value.c_str());  // large targets take seconds
        break;
      }
      case 9:
        otter_trace(gpu, in.byte() % 4);
        break;
      case 10:
        load_damaged(gpu, in);
        break;
      default:
        ask(gpu, in);
    }
  }
  (void)otter_last_error(gpu);
  otter_destroy(gpu);
  return 0;
}
