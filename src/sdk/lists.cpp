// Ordering tables and lists: clearing, linking, drawing.

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "ot/main_ram.h"
#include "ot/packet.h"
#include "ot/walker.h"
#include "sdk/console.h"
#include "sdk/environment.h"
#include "sdk/include/psxgpu.h"
#include "sdk/memory.h"

namespace sdk {
namespace {

constexpr std::uint32_t end_of_list = 0xffffff;

/// False, and a finding, if the 24 bits of a link cannot hold the address.
bool can_link(const void* p, const char* what, CallSite site) {
  if (is_linkable(p)) return true;
  the_console().lint.note("bad-pointer", site,
                          std::string(what) +
                              " lies outside the 8 MiB that a link reaches: expected static data, "
                              "main's stack or the program's heap");
  return false;
}

/// A tag without a payload may be the entry of a table, on which the packets to come hang.
void hang(std::uint32_t tag, Feed::Hook& hook) {
  if (hook.length != 0 && tag >= hook.address && (tag - hook.address) / 4 < hook.length) {
    hook.bucket = (tag - hook.address) / 4;
    return;
  }
  if (const auto entry = the_console().lint.entry(tag)) hook = {entry->bucket, entry->table, entry->length};
}

void draw_list(const std::uint32_t* list, CallSite site) {
  auto& console = the_console();
  if (!can_link(list, "the list", site)) return;
  console.bytes_copied += copy_memory(console.memory, console.ram);
  console.last_list = address_of(list);
  console.lint.draw(console.last_list, site);
  ++console.lists;
  struct Node {
    std::uint32_t address;
    std::span<const std::uint32_t> payload;
    Feed::Hook hook;
  };
  std::vector<Node> later;
  Feed::Hook hook;
  const auto walked = ot::walk(console.ram, console.last_list,
                               [&](std::uint32_t tag, std::span<const std::uint32_t> payload) {
                                 if (payload.empty()) return hang(tag, hook);
                                 if (console.reversed) {
                                   later.push_back({tag + 4, payload, hook});
                                 } else {
                                   console.feed.hang(hook);
                                   console.feed.packet(payload, tag + 4);
                                 }
                               });
  std::for_each(later.rbegin(), later.rend(), [&](const Node& node) {
    console.feed.hang(node.hook);
    console.feed.packet(node.payload, node.address);
  });
  console.feed.hang({});
  console.nodes += walked.nodes;
  console.words += walked.words;
  if (!walked) console.lint.note("list", site, "nothing is drawn: " + walked.message());
  console.depth.next_list();
}

void run_drawn_callback() {
  auto* callback = the_console().on_drawn;
  if (callback != nullptr) interrupt(callback);
}

void draw(const std::uint32_t* list, CallSite site) {
  {
    const Call call;
    draw_list(list, site);
  }
  run_drawn_callback();
}

void draw_with(const std::uint32_t* list, DRAWENV* environment, CallSite site) {
  {
    const Call call;
    put_environment(environment, site);
    draw_list(list, site);
  }
  run_drawn_callback();
}

void draw_buffer(const std::uint32_t* words, std::size_t count, CallSite site) {
  const Call call;
  if (count == 0 || !is_usable(words, "DrawBuffer", site)) return;
  const auto address = is_linkable(words) ? address_of(words) : 0;
  the_console().feed.packet(std::span(words, count), address);
}

void clear(std::uint32_t* table, std::size_t length, CallSite site) {
  the_console().lint.clear_table(address_of(table), static_cast<std::uint32_t>(length), site);
}

bool can_clear(std::uint32_t* table, std::size_t length, CallSite site) {
  if (length != 0)
    return can_link(table, "the table", site) && can_link(table + length - 1, "the table's end", site);
  the_console().lint.note("bad-size", site, "a table of no entries is cleared");
  return false;
}

}  // namespace
}  // namespace sdk

using sdk::address_of;

extern "C" {

void otter_link(void* ot, void* first, void* last) {
  const sdk::Busy busy;
  auto& console = sdk::the_console();
  const auto* site = __builtin_return_address(0);
  if (!sdk::can_link(ot, "the table", site) || !sdk::can_link(first, "the packet", site) ||
      !sdk::can_link(last, "the last packet", site)) {
    return;
  }
  const auto bytes = 4 + 4 * std::uint32_t{getlen(last)};
  console.lint.link(address_of(ot), address_of(first), address_of(last), bytes, site);
  if (console.depth.is_on()) console.depth.link(address_of(first));
  setaddr(last, getaddr(ot));
  setaddr(ot, first);
}

void AddPrim(uint32_t* ot, const void* pri) {
  otter_link(ot, const_cast<void*>(pri), const_cast<void*>(pri));
}

void ClearOTagR(uint32_t* ot, size_t length) {
  const auto* site = __builtin_return_address(0);
  if (!sdk::can_clear(ot, length, site)) return;
  sdk::clear(ot, length, site);
  ot[0] = sdk::end_of_list;
  for (std::size_t i = 1; i < length; ++i) ot[i] = address_of(&ot[i - 1]);
}

void ClearOTag(uint32_t* ot, size_t length) {
  const auto* site = __builtin_return_address(0);
  if (!sdk::can_clear(ot, length, site)) return;
  sdk::clear(ot, length, site);
  for (std::size_t i = 0; i + 1 < length; ++i) ot[i] = address_of(&ot[i + 1]);
  ot[length - 1] = sdk::end_of_list;
}

int DrawOTag(const uint32_t* ot) {
  sdk::draw(ot, __builtin_return_address(0));
  return 0;
}
int DrawOTagIRQ(const uint32_t* ot) {
  sdk::draw(ot, __builtin_return_address(0));
  return 0;
}
void DrawOTag2(const uint32_t* ot) { sdk::draw(ot, __builtin_return_address(0)); }
void DrawOTagIRQ2(const uint32_t* ot) { sdk::draw(ot, __builtin_return_address(0)); }
int DrawOTagEnv(const uint32_t* ot, DRAWENV* env) {
  sdk::draw_with(ot, env, __builtin_return_address(0));
  return 0;
}
int DrawOTagEnvIRQ(const uint32_t* ot, DRAWENV* env) {
  sdk::draw_with(ot, env, __builtin_return_address(0));
  return 0;
}

int DrawBuffer(const uint32_t* buf, size_t length) {
  sdk::draw_buffer(buf, length, __builtin_return_address(0));
  return 0;
}
int DrawBufferIRQ(const uint32_t* buf, size_t length) {
  sdk::draw_buffer(buf, length, __builtin_return_address(0));
  return 0;
}
void DrawBuffer2(const uint32_t* buf, size_t length) {
  sdk::draw_buffer(buf, length, __builtin_return_address(0));
}
void DrawBufferIRQ2(const uint32_t* buf, size_t length) {
  sdk::draw_buffer(buf, length, __builtin_return_address(0));
}

void DrawPrim(const void* pri) {
  const auto* site = __builtin_return_address(0);
  if (!sdk::is_usable(pri, "DrawPrim", site)) return;
  sdk::draw_buffer(static_cast<const std::uint32_t*>(pri) + 1, getlen(pri), site);
}

}  // extern "C"
