// libotterGPU.so: the GPU of an emulator with the PSEmu-Pro plugin interface. Nothing is thrown across, and
// no call needs another one before it. The window is a process of its own (door/window_process.h).
//
// Not modelled: time. Status bit 31 changes with every reading, for programs that poll it for lines.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "door/session.h"
#include "door/x11_keys.h"
#include "dump/compression.h"

namespace {

constexpr std::size_t ram_words = 0x200000 / 4;

std::unique_ptr<door::Session>& session_place() {
  static std::unique_ptr<door::Session> session;
  return session;
}

/// Some emulators call before GPUinit.
door::Session& session() {
  auto& place = session_place();
  if (!place) place = std::make_unique<door::Session>();
  return *place;
}

template <class Body>
auto guarded(Body&& body) noexcept -> decltype(body()) {
  try {
    return body();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "otter: %s\n", e.what());
  }
  return decltype(body())();
}

/// What GPUfreeze hands over: a version, the status, registers by their command number, VRAM. A state of ours
/// has what other plugins look for, and behind the registers all the rest.
struct Freeze {
  std::uint32_t version, status, control[256];
  std::uint8_t vram[1024 * 512 * 2];
};
static_assert(sizeof(Freeze) == 8 + 1024 + 1024 * 1024);
constexpr long freeze_load = 0, freeze_save = 1;

/// In `control`: a mark, how many bytes of the rest follow, and the rest: a saved state up to its VRAM, which
/// ends it, packed.
constexpr std::uint32_t rest_mark = 0x5254544f;
constexpr std::size_t mark_at = 16, length_at = 17, rest_at = 18;
constexpr std::size_t most_rest = (256 - rest_at) * 4;

/// A GPU with a z-buffer saves more than there is room for: its frame is brought to an end elsewhere.
std::vector<std::byte> state_without_depth(door::Device& device) {
  auto state = device.save();
  if (device.gpu().depth_plane() == nullptr) return state;
  gpu::Gpu plain;
  (void)plain.load(state);
  return plain.save();
}

long save(Freeze& freeze) {
  door::Device& device = session().device();
  const auto state = state_without_depth(device);
  const auto rest =
      dump::pack(std::span(state).first(state.size() - sizeof freeze.vram), dump::Compression::zstd);
  if (rest.size() > most_rest) {
    std::fprintf(stderr, "otter: the state has no room: nothing is saved\n");
    return 0;
  }
  const gpu::Display& display = device.gpu().display();
  std::memset(freeze.control, 0, sizeof freeze.control);
  freeze.version = 1;
  freeze.status = device.status();
  freeze.control[3] = display.is_off ? 1 : 0;
  freeze.control[5] = display.start;
  freeze.control[6] = display.horizontal_range;
  freeze.control[7] = display.vertical_range;
  freeze.control[8] = display.mode;
  freeze.control[mark_at] = rest_mark;
  freeze.control[length_at] = static_cast<std::uint32_t>(rest.size());
  std::memcpy(&freeze.control[rest_at], rest.data(), rest.size());
  std::memcpy(freeze.vram, state.data() + state.size() - sizeof freeze.vram, sizeof freeze.vram);
  return 1;
}

long refuse(const std::string& why) {
  std::fprintf(stderr, "otter: the saved state: %s\n", why.c_str());
  return 0;
}

/// A state of ours, or another plugin's: VRAM and the display registers.
long load(const Freeze& freeze) {
  door::Device& device = session().device();
  const std::span vram(reinterpret_cast<const std::byte*>(freeze.vram), sizeof freeze.vram);
  if (freeze.control[mark_at] == rest_mark) {
    const std::size_t length = freeze.control[length_at];
    if (length > most_rest) return refuse("its length is damaged");
    const auto* packed = reinterpret_cast<const std::byte*>(&freeze.control[rest_at]);
    auto state = dump::unpack({packed, length}, std::uint64_t{1} << 16);
    if (!state) return refuse("it is damaged");
    state->insert(state->end(), vram.begin(), vram.end());
    const auto error = device.load(*state);
    return error ? refuse(error->message) : 1;
  }
  device.gp1(0);
  for (const std::uint32_t n : {3U, 4U, 5U, 6U, 7U, 8U}) device.gp1(n << 24 | (freeze.control[n] & 0xffffff));
  auto pixels = device.gpu().vram().pixels();
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<std::uint16_t>(freeze.vram[2 * i] | freeze.vram[2 * i + 1] << 8);
  return 1;
}

}  // namespace

extern "C" {

const char* PSEgetLibName() { return "Otter, exact and traced"; }
unsigned long PSEgetLibType() { return 2; }               // a GPU
unsigned long PSEgetLibVersion() { return 1 << 16 | 1; }  // of the interface

long GPUinit() {
  return guarded([] {
    session();
    return 0L;
  });
}
long GPUshutdown() {
  return guarded([] {
    if (session_place()) session_place()->finish();
    session_place().reset();
    return 0L;
  });
}
long GPUopen(unsigned long* display, char* caption, char*) {
  return guarded([&] {
    if (display != nullptr) *display = door::open_key_display();
    session().open_window(caption != nullptr ? caption : "");
    return 0L;
  });
}
long GPUclose() {
  return guarded([] {
    if (session_place()) session_place()->close_window();
    return 0L;
  });
}

std::uint32_t GPUreadStatus() {
  return guarded([] {
    static std::uint32_t line = 0;
    line ^= 0x80000000;
    return (session().device().status() & 0x7fffffff) | line;
  });
}
std::uint32_t GPUreadData() {
  return guarded([] { return session().device().read(); });
}
void GPUreadDataMem(std::uint32_t* words, int count) {
  guarded([&] {
    if (words != nullptr && count > 0)
      session().device().read(std::span(words, static_cast<std::size_t>(count)));
  });
}
void GPUwriteStatus(std::uint32_t word) {
  guarded([&] { session().device().gp1(word); });
}
void GPUwriteData(std::uint32_t word) {
  guarded([&] { session().device().gp0(std::span(&word, 1)); });
}
void GPUwriteDataMem(std::uint32_t* words, int count) {
  guarded([&] {
    if (words != nullptr && count > 0)
      session().device().gp0(std::span<const std::uint32_t>(words, static_cast<std::size_t>(count)));
  });
}
long GPUdmaChain(std::uint32_t* ram, std::uint32_t head) {
  return guarded([&] {
    if (ram != nullptr) session().send_list(std::span<const std::uint32_t>(ram, ram_words), head & 0xffffff);
    return 0L;
  });
}
void GPUupdateLace() {
  guarded([] { session().field(); });
}
void GPUaddVertex(short x, short y, std::int64_t fx, std::int64_t fy, std::int64_t z) {
  guarded([&] {
    const std::uint32_t xy =
        std::uint32_t{static_cast<std::uint16_t>(x)} | std::uint32_t{static_cast<std::uint16_t>(y)} << 16;
    const std::int64_t limited = std::clamp<std::int64_t>(z, 0, 0xfffff);  // 20 bits before the point
    session().device().vertex(xy, static_cast<std::uint32_t>(limited) << 12,
                              static_cast<std::uint8_t>(fx >> 8 & 0xff),
                              static_cast<std::uint8_t>(fy >> 8 & 0xff));
  });
}

/// 1: done; 0: not. Mode 2 selects a slot to be shown, which needs nothing here.
long GPUfreeze(std::uint32_t mode, void* memory) {
  return guarded([&]() -> long {
    if (mode != freeze_load && mode != freeze_save) return 1;
    if (memory == nullptr) return 0;
    return mode == freeze_save ? save(*static_cast<Freeze*>(memory))
                               : load(*static_cast<const Freeze*>(memory));
  });
}

void GPUmakeSnapshot() {
  guarded([] { session().snapshot(); });
}
void GPUkeypressed(int key) {
  guarded([&] {
    // A window takes its keys itself.
    if (key == static_cast<int>(door::keysym_f8) && !session().has_window()) session().toggle_recording();
  });
}
void GPUdisplayText(char* text) {
  if (text != nullptr) std::fprintf(stderr, "otter: %s\n", text);
}

/// 128 x 96, blue, green, red, from the top: the thumbnail of a saved state.
void GPUgetScreenPic(unsigned char* bgr) {
  guarded([&] {
    if (bgr == nullptr) return;
    constexpr int width = 128, height = 96;
    const auto picture = session().device().picture();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x, bgr += 3) {
        base::Rgba pixel;
        if (picture.width > 0 && picture.height > 0)
          pixel = picture.at(x * picture.width / width, y * picture.height / height);
        bgr[0] = pixel.b;
        bgr[1] = pixel.g;
        bgr[2] = pixel.r;
      }
    }
  });
}

// Who asks for these looks at the emulator's window; what there is to say goes where all else is said.
long GPUconfigure() {
  std::fputs(
      "otter: knobs are set in the window (F2), the rest by variables of the environment (OTTER_...)\n",
      stderr);
  return 0;
}
void GPUabout() {
  std::fputs(
      "otter: a GPU to the bit, with its ordering tables, depths and pixels open to view (MIT licence)\n",
      stderr);
}

// What the interface has and this plugin needs nothing for.
long GPUtest() { return 0; }
long GPUgetMode() { return 0; }
void GPUsetMode(std::uint32_t) {}
void GPUshowScreenPic(unsigned char*) {}
void GPUclearDynarec(void (*)()) {}
void GPUhSync(int) {}
void GPUvBlank(int) {}
void GPUvisualVibration(std::uint32_t, std::uint32_t) {}
void GPUcursor(int, int, int) {}
void GPUdisplayFlags(std::uint32_t) {}
void GPUsetfix(std::uint32_t) {}

}  // extern "C"
