// window_host PLUGIN FIELDS: loads the plugin as an emulator does, opens it and runs a program of two turning
// squares in it for so many fields, or until Escape is typed. Says on stdout what keys arrive, and at the end
// how many fields there were and a sum over VRAM.

#include <X11/Xlib.h>
#include <X11/keysym.h>
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

void* library = nullptr;

template <class Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

constexpr std::uint32_t table = 0x1000, entries = 16, packets = 0x2000;

/// A list: the table downwards, and a triangle in entries 9 and 4.
std::uint32_t make_list(std::vector<std::uint32_t>& ram, std::uint32_t field) {
  for (std::uint32_t n = 0; n < entries; ++n) ram[table / 4 + n] = n == 0 ? 0xffffff : table + 4 * (n - 1);
  auto* const tell = find<void(short, short, std::int64_t, std::int64_t, std::int64_t)>("GPUaddVertex");
  const std::uint32_t moved = field % 100;
  for (std::uint32_t n = 0; n < 2; ++n) {
    const std::uint32_t bucket = n == 0 ? 9 : 4, at = packets + n * 0x40;
    const std::array<std::uint32_t, 3> x{40 + n * 60 + moved, 180 + n * 20, 60 + n * 40},
        y{30 + n * 20, 90, 200 - n * 30};
    std::uint32_t* const words = &ram[at / 4];
    words[0] = 4U << 24 | (table + 4 * (bucket - 1));
    words[1] = n == 0 ? 0x200000ff : 0x2000c040;
    for (std::size_t v = 0; v < 3; ++v) {
      words[2 + v] = x[v] | y[v] << 16;
      tell(static_cast<short>(x[v]), static_cast<short>(y[v]), std::int64_t{x[v]} << 16,
           std::int64_t{y[v]} << 16, static_cast<std::int64_t>(1000 - 300 * n + 400 * v));
    }
    ram[table / 4 + bucket] = at;
  }
  return table + 4 * (entries - 1);
}

bool is_ended_by_key(Display* display) {
  while (display != nullptr && XPending(display) > 0) {
    XEvent event;
    XNextEvent(display, &event);
    if (event.type != KeyPress && event.type != KeyRelease) continue;
    const auto key = XLookupKeysym(&event.xkey, 0);
    std::printf("key %lx %s\n", key, event.type == KeyPress ? "down" : "up");
    std::fflush(stdout);
    if (key == XK_Escape) return true;
  }
  return false;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) return 2;
  library = dlopen(words[1], RTLD_NOW);
  if (library == nullptr) {
    std::fprintf(stderr, "window_host: %s\n", dlerror());
    return 2;
  }
  find<long()>("GPUinit")();
  unsigned long opened = 0;
  std::string title = "squares";
  find<long(unsigned long*, char*, char*)>("GPUopen")(&opened, title.data(), nullptr);
  auto* const display = reinterpret_cast<Display*>(opened);
  auto* const control = find<void(std::uint32_t)>("GPUwriteStatus");
  auto* const send = find<void(std::uint32_t*, int)>("GPUwriteDataMem");
  for (const std::uint32_t word : {0x03000000U, 0x06c60260U, 0x07040010U, 0x08000001U}) control(word);
  std::vector<std::uint32_t> ram(0x200000 / 4);
  long field = 0;
  for (const long last = std::atol(words[2]); field < last && !is_ended_by_key(display); ++field) {
    const std::uint32_t y = field % 2 == 0 ? 0 : 256;
    control(0x05000000 | (256 - y) << 10);
    std::array<std::uint32_t, 6> environment{
        0xe3000000 | y << 10, 0xe4000000 | (y + 239) << 10 | 319, 0xe5000000 | y << 11, 0x02402010, y << 16,
        240U << 16 | 320};
    send(environment.data(), static_cast<int>(environment.size()));
    const auto head = make_list(ram, static_cast<std::uint32_t>(field));
    find<long(std::uint32_t*, std::uint32_t)>("GPUdmaChain")(ram.data(), head);
    find<void()>("GPUupdateLace")();
  }
  std::array<std::uint32_t, 3> ask{0xc0000000, 0, 512U << 16 | 320};
  send(ask.data(), 3);
  std::uint32_t sum = 0;
  for (std::uint32_t n = 0; n < 320 * 512 / 2; ++n) sum = sum * 31 + find<std::uint32_t()>("GPUreadData")();
  std::printf("fields %ld sum %08x\n", field, sum);
  find<long()>("GPUclose")();
  find<long()>("GPUshutdown")();
  return 0;
}
