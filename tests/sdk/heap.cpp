// The heap that programs get in place of malloc and new.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

extern "C" {
void* otter_malloc(std::size_t bytes);
void* otter_calloc(std::size_t count, std::size_t bytes);
void* otter_realloc(void* p, std::size_t bytes);
void otter_free(void* p);
int otter_rand(void);
void otter_srand(unsigned value);
}

TEST_SUITE("sdk") {
  TEST_CASE("blocks are aligned, apart, and keep what is written until they are freed") {
    std::mt19937 random(1);
    struct Block {
      unsigned char* bytes;
      std::size_t count;
      unsigned char fill;
    };
    std::vector<Block> blocks;
    for (int n = 0; n < 4000; ++n) {
      if (blocks.size() > 60 || (!blocks.empty() && random() % 3 == 0)) {
        const auto at = random() % blocks.size();
        const Block b = blocks[at];
        REQUIRE(std::count(b.bytes, b.bytes + b.count, b.fill) == static_cast<std::ptrdiff_t>(b.count));
        otter_free(b.bytes);
        blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(at));
        continue;
      }
      const std::size_t count = random() % 5000;
      auto* bytes = static_cast<unsigned char*>(otter_malloc(count));
      REQUIRE(bytes != nullptr);
      REQUIRE(reinterpret_cast<std::uintptr_t>(bytes) % 16 == 0);
      const auto fill = static_cast<unsigned char>(n);
      std::memset(bytes, fill, count);
      blocks.push_back({bytes, count, fill});
    }
    for (const auto& b : blocks) otter_free(b.bytes);
  }

  TEST_CASE("after everything is freed the largest block fits again; one too large never does") {
    auto* a = otter_malloc(400'000);
    auto* b = otter_malloc(400'000);
    REQUIRE(a != nullptr);
    REQUIRE(b != nullptr);
    CHECK(otter_malloc(400'000) == nullptr);
    otter_free(a);
    otter_free(b);
    auto* whole = otter_malloc(1'000'000);
    CHECK(whole != nullptr);
    otter_free(whole);
    CHECK(otter_malloc(SIZE_MAX) == nullptr);
    CHECK(otter_calloc(SIZE_MAX / 2, 4) == nullptr);
  }

  TEST_CASE("realloc keeps the contents, calloc gives zeros") {
    auto* p = static_cast<char*>(otter_malloc(4));
    std::memcpy(p, "abc", 4);
    auto* q = static_cast<char*>(otter_realloc(p, 4000));
    CHECK(std::memcmp(q, "abc", 4) == 0);
    otter_free(q);
    auto* z = static_cast<char*>(otter_calloc(10, 10));
    CHECK(std::count(z, z + 100, 0) == 100);
    otter_free(z);
  }

  TEST_CASE("rand is bits 16-30 of x = x * 41C64E6Dh + 3039h") {
    otter_srand(0);
    CHECK(otter_rand() == 0);  // 3039h >> 16
    CHECK(otter_rand() == 21468);
    CHECK(otter_rand() == 9988);
  }
}
