// The plugin, loaded and called as an emulator does.

#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "gpu/gpu.h"
#include "tests/gpu/random_words.h"

namespace {

using Words = std::vector<std::uint32_t>;

/// A function of the plugin by its name.
template <class Function>
Function* find(const char* name) {
  static void* const library = dlopen(OTTER_PLUGIN, RTLD_NOW | RTLD_LOCAL);
  REQUIRE_MESSAGE(library != nullptr, dlerror());
  void* const symbol = dlsym(library, name);
  REQUIRE_MESSAGE(symbol != nullptr, name);
  return reinterpret_cast<Function*>(symbol);
}

struct Freeze {
  std::uint32_t version, status, control[256];
  std::uint8_t vram[1024 * 1024];
  std::uint32_t behind = 0x12345678;  // the emulator's own
};

struct Plugin {
  Plugin() { REQUIRE(find<long()>("GPUinit")() == 0); }
  ~Plugin() { find<long()>("GPUshutdown")(); }

  void send(Words words) {
    find<void(std::uint32_t*, int)>("GPUwriteDataMem")(words.data(), static_cast<int>(words.size()));
  }
  void send_one(std::uint32_t word) { find<void(std::uint32_t)>("GPUwriteData")(word); }
  void control(std::uint32_t word) { find<void(std::uint32_t)>("GPUwriteStatus")(word); }
  std::uint32_t status() { return find<std::uint32_t()>("GPUreadStatus")(); }
  std::uint32_t read() { return find<std::uint32_t()>("GPUreadData")(); }
  /// Two pixels of a row.
  std::uint32_t pixels(std::uint32_t x, std::uint32_t y) {
    send({0xc0000000, x | y << 16, 2 | 1 << 16});
    return read();
  }
};

}  // namespace

TEST_SUITE("plugin") {
  TEST_CASE("The plugin says that it is a GPU") {
    CHECK(find<unsigned long()>("PSEgetLibType")() == 2);
    CHECK(std::string(find<const char*()>("PSEgetLibName")()).find("Otter") == 0);
    CHECK((find<unsigned long()>("PSEgetLibVersion")() >> 16) == 1);
  }

  TEST_CASE("Words in blocks and one by one arrive, and pixels are read back") {
    Plugin plugin;
    plugin.send({0xe3000000, 0xe407ffff, 0x600000ff, 4 | 4 << 16, 2 | 1 << 16});
    CHECK(plugin.pixels(4, 4) == 0x001f001f);
    for (const std::uint32_t word : {0x6000ff00U, 8U, 2U | 1U << 16}) plugin.send_one(word);
    CHECK(plugin.pixels(8, 0) == 0x03e003e0);
  }

  TEST_CASE("Status bit 31 changes with every reading") {
    Plugin plugin;
    const auto changed = plugin.status() ^ plugin.status();
    CHECK((changed >> 31) == 1);
  }

  TEST_CASE("A list is drawn from the emulator's RAM; one that loops ends") {
    Plugin plugin;
    plugin.send({0xe3000000, 0xe407ffff});
    Words ram(0x200000 / 4);
    const Words packet{3U << 24 | 0xffffff, 0x600000ff, 0, 2 | 1 << 16};
    std::copy(packet.begin(), packet.end(), ram.begin() + 0x100);
    const auto chain = find<long(std::uint32_t*, std::uint32_t)>("GPUdmaChain");
    CHECK(chain(ram.data(), 0x400) == 0);
    CHECK(plugin.pixels(0, 0) == 0x001f001f);
    ram[0x100] = 3U << 24 | 0x400;
    CHECK(chain(ram.data(), 0x80000400) == 0);
    CHECK(chain(nullptr, 0) == 0);
  }

  TEST_CASE("A frozen state goes on where it was taken, in the middle of an upload") {
    Plugin plugin;
    const auto freeze = find<long(std::uint32_t, void*)>("GPUfreeze");
    const auto memory = std::make_unique<Freeze>();
    plugin.send({0xa0000000, 0, 4 | 1 << 16, 0x22221111});
    REQUIRE(freeze(1, memory.get()) == 1);
    plugin.control(0);
    plugin.send({0x02ffffff, 0, 16 | 16 << 16});
    REQUIRE(freeze(0, memory.get()) == 1);
    plugin.send_one(0x44443333);
    CHECK(plugin.pixels(0, 0) == 0x22221111);
    CHECK(plugin.pixels(2, 0) == 0x44443333);
    CHECK(freeze(0, nullptr) == 0);
    CHECK(memory->behind == 0x12345678);
    CHECK(memory->vram[0] == 0x11);  // where other plugins look for it
    CHECK(memory->vram[1] == 0x11);
    for (const std::size_t damaged : {17U, 18U, 20U}) {
      CAPTURE(damaged);
      auto other = std::make_unique<Freeze>(*memory);
      other->control[damaged] ^= 0xffff;
      CHECK(freeze(0, other.get()) == 0);
    }
  }

  TEST_CASE("A state with a palette of noise has room, too") {
    Plugin plugin;
    Words noise{0xa0000000, 256 << 16, 256 | 1 << 16};
    std::uint32_t random = 1;
    for (int n = 0; n < 128; ++n) noise.push_back(random = random * 1664525 + 1013904223);
    plugin.send(noise);
    // A rectangle of 8-bit texels takes the palette into the cache.
    plugin.send({0xe1000080, 0xe3000000, 0xe407ffff, 0x65000000, 0, 256 << 22, 1 | 1 << 16});
    const auto memory = std::make_unique<Freeze>();
    const auto freeze = find<long(std::uint32_t, void*)>("GPUfreeze");
    REQUIRE(freeze(1, memory.get()) == 1);
    CHECK(freeze(0, memory.get()) == 1);
  }

  TEST_CASE("Another plugin's frozen state gives its VRAM and display") {
    Plugin plugin;
    const auto memory = std::make_unique<Freeze>();
    memory->vram[0] = 0x34;
    memory->vram[1] = 0x12;
    memory->control[8] = 1;
    REQUIRE(find<long(std::uint32_t, void*)>("GPUfreeze")(0, memory.get()) == 1);
    CHECK(plugin.pixels(0, 0) == 0x1234);
    CHECK((plugin.status() >> 17 & 3) == 1);
  }

  TEST_CASE("Calls before GPUinit, after GPUshutdown and with null pointers do no harm") {
    find<void(std::uint32_t)>("GPUwriteData")(0x02ffffff);
    CHECK(find<long()>("GPUshutdown")() == 0);
    CHECK(find<long()>("GPUshutdown")() == 0);
    find<void(std::uint32_t*, int)>("GPUwriteDataMem")(nullptr, 5);
    find<void(std::uint32_t*, int)>("GPUreadDataMem")(nullptr, -1);
    find<void(char*)>("GPUdisplayText")(nullptr);
    find<void(unsigned char*)>("GPUgetScreenPic")(nullptr);
    find<void(short, short, std::int64_t, std::int64_t, std::int64_t)>("GPUaddVertex")(0, 0, -1, INT64_MAX,
                                                                                       INT64_MIN);
    find<void()>("GPUupdateLace")();
    CHECK(find<long()>("GPUclose")() == 0);
  }
}
