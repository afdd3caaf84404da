#pragma once
// What is wrong with how a program uses tables, packets and the coprocessor: things that draw by luck, or
// that the console, which draws while the program goes on, would show otherwise. Each finding names the call
// site.
//
//   bucket-range         a packet goes to a word beside a table: entry -1, the length (> where >= is needed),
//   ... linked-to-itself     the packet is the entry it is put into linked-twice         a packet is put into
//   one table twice: what followed it is lost, or the list is a loop two-tables           a packet still
//   hangs in another table that is not drawn yet, or may be being drawn cleared-late         a table is
//   cleared that has packets nobody has drawn not-cleared          a table is drawn again with what it
//   already had written-while-drawn  a table is changed after DrawOTag, before DrawSync or VSync overrun a
//   packet lies over a table or an environment: its buffer is full texture-page         a texture page, or
//   the part of it that is used, lies outside VRAM flag-ignored         a vertex overflowed (FLAG bit 31),
//   nobody read FLAG, and its packet was linked bad-pointer          a pointer that the call cannot use
//   bad-size             a rectangle outside what the GPU can do
//   list                 a list that does not end

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sdk/call_site.h"

namespace sdk {

struct Finding {
  std::string kind;
  CallSite site = nullptr;
  std::string text;         ///< of the first time
  std::uint32_t frame = 0;  ///< of the first time
  std::uint64_t times = 0;
};

/// "what is wrong (frame 12, 2 times)".
std::string to_text(const Finding& finding);

class ProgramLint {
 public:
  /// Vertical blanks so far: what findings are dated with.
  std::uint32_t frame = 0;

  // Addresses in bytes, lengths in entries (tables) or bytes.
  void clear_table(std::uint32_t address, std::uint32_t length, CallSite site);
  /// Packets first..last were put behind `entry`; `bytes` of the last one with its tag.
  void link(std::uint32_t entry, std::uint32_t first, std::uint32_t last, std::uint32_t bytes, CallSite site);
  void draw(std::uint32_t head, CallSite site);
  /// DrawSync or VSync: whatever was drawn is finished.
  void sync();
  void environment(std::uint32_t address, std::uint32_t bytes);
  /// One polygon or rectangle as it is sent, and the texture page that counts for it.
  void textured(std::uint32_t page, std::uint32_t largest_u);
  void flag_set(bool is_error) { flag_pending_ = flag_pending_ || is_error; }
  void flag_read() { flag_pending_ = false; }

  void note(std::string_view kind, CallSite site, std::string text);

  /// In the order in which they were first found.
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

  /// The table, cleared by ClearOTag or ClearOTagR, that holds the word at `address`, and which of its
  /// entries that is.
  struct Entry {
    std::uint32_t table = 0, length = 0, bucket = 0;
  };
  [[nodiscard]] std::optional<Entry> entry(std::uint32_t address) const;
  /// Where the packet was linked; nullptr: not known.
  [[nodiscard]] CallSite site_of(std::uint32_t packet) const;

 private:
  struct Table {
    std::uint32_t address = 0, length = 0;
    std::uint32_t clears = 0;  // so often
    std::uint32_t linked = 0;  // packets since it was cleared
    std::uint32_t drawn = 0;   // of those
    bool is_being_drawn = false;
    std::vector<std::size_t> nested{};  // tables that hang in it
    [[nodiscard]] std::uint32_t end() const { return address + 4 * length; }
  };
  struct Place {  // of a packet
    std::size_t table = 0;
    std::uint32_t clears = 0;
  };

  [[nodiscard]] std::optional<std::size_t> table_of(std::uint32_t entry) const;
  void check_range(std::uint32_t entry, CallSite site);
  void check_overrun(std::uint32_t begin, std::uint32_t end, CallSite site);
  void mark_drawn(std::size_t table, int depth);
  void check_place(std::uint32_t packet, std::size_t table, CallSite site);

  std::vector<Table> tables_;
  mutable std::size_t last_table_ = 0;
  std::unordered_map<std::uint32_t, Place> places_;
  std::unordered_map<std::uint32_t, CallSite> sites_;    // of packets
  std::map<std::uint32_t, std::uint32_t> environments_;  // begin, end
  bool flag_pending_ = false;
  CallSite draw_site_ = nullptr;
  std::vector<Finding> findings_;
  std::map<std::pair<std::string, CallSite>, std::size_t, std::less<>> index_;
};

}  // namespace sdk
