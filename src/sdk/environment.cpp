// Video mode, display and draw environments.

#include "sdk/environment.h"

#include <cstring>
#include <span>

#include "ot/gp0.h"
#include "ot/gp1.h"
#include "sdk/console.h"
#include "sdk/memory.h"

namespace sdk {
namespace {

namespace gp0 = ot::gp0;

GPU_VideoMode video_mode = MODE_NTSC;

std::uint32_t low_bits(int value, std::uint32_t mask) { return static_cast<std::uint32_t>(value) & mask; }

/// The width code of GP1(08h) for a width in pixels: the widest mode that is not much wider.
std::uint32_t width_code(int width) {
  constexpr std::uint32_t code_384 = 1u << 6;
  return width > 560 ? 3 : width > 400 ? 2 : width > 352 ? code_384 : width > 280 ? 1 : 0;
}

std::uint32_t mode_word(const DISPENV& env) {
  std::uint32_t word = width_code(env.disp.w);
  if (env.disp.h > 256) word |= DISP_HEIGHT_HIGH;
  if (video_mode == MODE_PAL) word |= DISP_MODE_PAL;
  if ((env.isrgb24 & 1) != 0) word |= DISP_24BIT_COLOR;
  if ((env.isinter & 1) != 0) word |= DISP_INTERLACE;
  if ((env.reverse & 1) != 0) word |= 1u << 7;
  return word;
}

/// 5 bits of a texture window from a size: its bits 3 and up, and every bit below the highest one set.
std::uint32_t window_mask(int size) {
  std::uint32_t mask = static_cast<std::uint32_t>(size) >> 3;
  mask |= mask << 1;
  mask |= mask << 2;
  mask |= mask << 4;
  return mask & 31;
}

/// A draw environment as its packet.
void make_packet(DRAWENV& env) {
  auto& out = env.dr_env;
  out.tpage.code[0] = 0xe1000000U | env.tpage | (env.dtd & 1U) << 9 | (env.dfe & 1U) << 10;
  out.twin.code[0] = 0xe2000000U | window_mask(env.tw.w) | window_mask(env.tw.h) << 5 |
                     (static_cast<std::uint32_t>(env.tw.x) >> 3 & 31) << 10 |
                     (static_cast<std::uint32_t>(env.tw.y) >> 3 & 31) << 15;
  const auto& clip = env.clip;
  const auto corner = [](int x, int y) { return low_bits(x, 0x3ff) | low_bits(y, 0x3ff) << 10; };
  out.area.code[0] = 0xe3000000U | corner(clip.x, clip.y);
  out.area.code[1] = 0xe4000000U | corner(clip.x + clip.w - 1, clip.y + clip.h - 1);
  out.offset.code[0] =
      0xe5000000U | low_bits(clip.x + env.ofs[0], 0x7ff) | low_bits(clip.y + env.ofs[1], 0x7ff) << 11;
  setlen(&out, 5);
  termPrim(&out);
  if (env.isbg == 0) return;
  constexpr int tallest_fill = 511;
  out.fill = {env.r0,
              env.g0,
              env.b0,
              0x02,
              static_cast<std::uint16_t>(clip.x),
              static_cast<std::uint16_t>(clip.y),
              static_cast<std::uint16_t>(clip.w),
              static_cast<std::uint16_t>(clip.h < tallest_fill ? clip.h : tallest_fill)};
  setlen(&out, 8);
}

void send(const DRAWENV& env) {
  std::array<std::uint32_t, sizeof(DR_ENV) / 4> words{};
  std::memcpy(words.data(), &env.dr_env, sizeof env.dr_env);
  the_console().feed.gp0(std::span(words).subspan(1, getlen(&env.dr_env)));
}

void watch(const void* env, std::size_t bytes) {
  if (is_linkable(env)) the_console().lint.environment(address_of(env), static_cast<std::uint32_t>(bytes));
}

}  // namespace

void put_environment(DRAWENV* env, CallSite site) {
  if (!is_usable(env, "PutDrawEnv", site)) return;
  make_packet(*env);
  watch(env, sizeof *env);
  send(*env);
}

}  // namespace sdk

using sdk::Call;
using sdk::the_console;

namespace gp1 = ot::gp1;

extern "C" {

void ResetGraph(int mode) {
  const Call call;
  auto& feed = the_console().feed;
  if (mode == 0) return feed.gp1(gp1::make(gp1::Command::reset));
  feed.gp1(gp1::make(gp1::Command::clear_fifo));
  feed.gp1(gp1::make(gp1::Command::acknowledge_irq));
  feed.gp1(gp1::make(gp1::Command::dma_direction));
}

GPU_VideoMode GetVideoMode(void) { return sdk::video_mode; }
void SetVideoMode(GPU_VideoMode mode) { sdk::video_mode = mode; }

void SetDispMask(int mask) {
  const Call call;
  the_console().feed.gp1(gp1::display_off::make(mask == 0));
}

void PutDispEnv(const DISPENV* env) {
  const Call call;
  if (!sdk::is_usable(env, "PutDispEnv", __builtin_return_address(0))) return;
  sdk::watch(env, sizeof *env);
  // Around the middle of the picture; a pixel of the widest mode's grid is 10 video clocks wide here.
  const int half_width = (env->screen.w != 0 ? env->screen.w : 256) * 10 / 2;
  const int half_height = (env->screen.h != 0 ? env->screen.h : 240) / 2;
  const int x = env->screen.x + 0x760, y = env->screen.y + (sdk::video_mode == MODE_PAL ? 0xa3 : 0x88);
  auto& feed = the_console().feed;
  feed.gp1(gp1::display_start::make(env->disp.x, env->disp.y));
  feed.gp1(gp1::horizontal_range::make(sdk::low_bits(x - half_width, 0xfff),
                                       sdk::low_bits(x + half_width, 0xfff)));
  feed.gp1(gp1::vertical_range::make(sdk::low_bits(y - half_height, 0x3ff),
                                     sdk::low_bits(y + half_height, 0x3ff)));
  feed.gp1(gp1::display_mode::make(sdk::mode_word(*env)));
}

void PutDrawEnv(DRAWENV* env) {
  const Call call;
  sdk::put_environment(env, __builtin_return_address(0));
}

void PutDrawEnvFast(DRAWENV* env) {
  const Call call;
  if (!sdk::is_usable(env, "PutDrawEnvFast", __builtin_return_address(0))) return;
  if (env->dr_env.tag == 0) sdk::make_packet(*env);
  sdk::send(*env);
}

int GetODE(void) {
  const Call call;
  return static_cast<int>(the_console().gpu.status() >> 31);
}

int IsIdleGPU(int) { return 0; }

DISPENV* SetDefDispEnv(DISPENV* env, int x, int y, int w, int h) {
  if (!sdk::is_usable(env, "SetDefDispEnv", __builtin_return_address(0))) return env;
  *env = {};
  setRECT(&env->disp, static_cast<int16_t>(x), static_cast<int16_t>(y), static_cast<int16_t>(w),
          static_cast<int16_t>(h));
  return env;
}

DRAWENV* SetDefDrawEnv(DRAWENV* env, int x, int y, int w, int h) {
  if (!sdk::is_usable(env, "SetDefDrawEnv", __builtin_return_address(0))) return env;
  *env = {};
  setRECT(&env->clip, static_cast<int16_t>(x), static_cast<int16_t>(y), static_cast<int16_t>(w),
          static_cast<int16_t>(h));
  setRECT(&env->tw, 0, 0, 256, 256);
  env->tpage = 10;
  env->dtd = 1;
  return env;
}

}  // extern "C"
