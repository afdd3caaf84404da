// Pixels in and out of VRAM, and TIM files.

#include <array>
#include <cstdint>
#include <string>

#include "ot/gp0.h"
#include "sdk/console.h"
#include "sdk/include/psxgpu.h"

namespace sdk {
namespace {

std::uint32_t pair(int x, int y) {
  return (static_cast<std::uint32_t>(x) & 0xffff) | static_cast<std::uint32_t>(y) << 16;
}

/// False, and a finding, unless the rectangle is one that VRAM can hold.
bool is_usable_area(const RECT* rect, const char* call, CallSite site) {
  if (!is_usable(rect, call, site)) return false;
  if (rect->w >= 1 && rect->w <= 1024 && rect->h >= 1 && rect->h <= 512) return true;
  the_console().lint.note("bad-size", site,
                          std::string(call) + " is given " + std::to_string(rect->w) + " x " +
                              std::to_string(rect->h) + " pixels, expected 1 x 1 to 1024 x 512");
  return false;
}

/// Two pixels a word.
std::size_t words_of(const RECT& rect) {
  return (static_cast<std::size_t>(rect.w) * static_cast<std::size_t>(rect.h) + 1) / 2;
}

void load(const RECT* rect, const std::uint32_t* data, CallSite site) {
  const Call call;
  if (!is_usable_area(rect, "LoadImage", site) || !is_usable(data, "LoadImage", site)) return;
  auto& feed = the_console().feed;
  constexpr std::uint32_t clear_cache = 0x01000000, upload = 0xa0000000;
  feed.gp0(std::array{clear_cache});
  feed.gp0(std::array{upload, pair(rect->x, rect->y), pair(rect->w, rect->h)});
  feed.gp0(std::span(data, words_of(*rect)));
}

void store(const RECT* rect, std::uint32_t* data, CallSite site) {
  const Call call;
  if (!is_usable_area(rect, "StoreImage", site) || !is_usable(data, "StoreImage", site)) return;
  auto& feed = the_console().feed;
  constexpr std::uint32_t download = 0xc0000000;
  feed.gp0(std::array{download, pair(rect->x, rect->y), pair(rect->w, rect->h)});
  feed.read(std::span(data, words_of(*rect)));
}

void move(const RECT* rect, int x, int y, CallSite site) {
  const Call call;
  if (!is_usable_area(rect, "MoveImage", site)) return;
  constexpr std::uint32_t copy = 0x80000000;
  the_console().feed.gp0(std::array{copy, pair(rect->x, rect->y), pair(x, y), pair(rect->w, rect->h)});
}

/// The block of a TIM at `words`: length in bytes, position, size, pixels.
struct Block {
  RECT* rect;
  std::uint32_t* pixels;
  std::uint32_t* after;
};
Block block_at(std::uint32_t* words) {
  return {reinterpret_cast<RECT*>(words + 1), words + 3, words + words[0] / 4};
}

constexpr std::uint32_t tim_id = 0x10, tim_has_clut = 8;
constexpr std::uint32_t block_head_bytes = 12;

}  // namespace
}  // namespace sdk

extern "C" {

int LoadImage(const RECT* rect, const uint32_t* data) {
  sdk::load(rect, data, __builtin_return_address(0));
  return 0;
}
void LoadImage2(const RECT* rect, const uint32_t* data) {
  sdk::load(rect, data, __builtin_return_address(0));
}

int StoreImage(const RECT* rect, uint32_t* data) {
  sdk::store(rect, data, __builtin_return_address(0));
  return 0;
}
void StoreImage2(const RECT* rect, uint32_t* data) { sdk::store(rect, data, __builtin_return_address(0)); }

int MoveImage(const RECT* rect, int x, int y) {
  sdk::move(rect, x, y, __builtin_return_address(0));
  return 0;
}
void MoveImage2(const RECT* rect, int x, int y) { sdk::move(rect, x, y, __builtin_return_address(0)); }

int GetTimInfo(const uint32_t* tim, TIM_IMAGE* info) {
  const auto* site = __builtin_return_address(0);
  if (!sdk::is_usable(tim, "GetTimInfo", site) || !sdk::is_usable(info, "GetTimInfo", site)) return 1;
  if ((tim[0] & 0xffff) != sdk::tim_id) return 1;
  *info = {};
  info->mode = tim[1];
  auto* at = const_cast<std::uint32_t*>(tim + 2);
  if ((info->mode & sdk::tim_has_clut) != 0) {
    const auto clut = sdk::block_at(at);
    if (at[0] < sdk::block_head_bytes) return 2;
    info->crect = clut.rect;
    info->caddr = clut.pixels;
    at = clut.after;
  }
  if (at[0] <= sdk::block_head_bytes) return 0;
  const auto pixels = sdk::block_at(at);
  info->prect = pixels.rect;
  info->paddr = pixels.pixels;
  return 0;
}

int GsGetTimInfo(const uint32_t* tim, GsIMAGE* info) {
  TIM_IMAGE parts;
  const auto* site = __builtin_return_address(0);
  if (!sdk::is_usable(tim, "GsGetTimInfo", site) || !sdk::is_usable(info, "GsGetTimInfo", site)) return 1;
  if (const int failed = GetTimInfo(tim, &parts); failed != 0) return failed;
  *info = {};
  info->pmode = parts.mode;
  if (parts.prect != nullptr) {
    info->px = parts.prect->x;
    info->py = parts.prect->y;
    info->pw = parts.prect->w;
    info->ph = parts.prect->h;
    info->pixel = parts.paddr;
  }
  if (parts.crect != nullptr) {
    info->cx = parts.crect->x;
    info->cy = parts.crect->y;
    info->cw = parts.crect->w;
    info->ch = parts.crect->h;
    info->clut = parts.caddr;
  }
  return 0;
}

}  // extern "C"
