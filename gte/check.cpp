#include "gte/check.h"

#include <array>
#include <charconv>
#include <iomanip>
#include <ostream>
#include <utility>
#include <vector>

#include "gte/commands.h"

namespace gte {
namespace {

constexpr std::array<std::string_view, 64> names{
    "VXY0",   "VZ0",    "VXY1",   "VZ1",    "VXY2", "VZ2",  "RGBC", "OTZ",    // 0
    "IR0",    "IR1",    "IR2",    "IR3",    "SXY0", "SXY1", "SXY2", "SXYP",   // 8
    "SZ0",    "SZ1",    "SZ2",    "SZ3",    "RGB0", "RGB1", "RGB2", "RES1",   // 16
    "MAC0",   "MAC1",   "MAC2",   "MAC3",   "IRGB", "ORGB", "LZCS", "LZCR",   // 24
    "R11R12", "R13R21", "R22R23", "R31R32", "R33",  "TRX",  "TRY",  "TRZ",    // 32
    "L11L12", "L13L21", "L22L23", "L31L32", "L33",  "RBK",  "GBK",  "BBK",    // 40
    "LR1LR2", "LR3LG1", "LG2LG3", "LB1LB2", "LB3",  "RFC",  "GFC",  "BFC",    // 48
    "OFX",    "OFY",    "H",      "DQA",    "DQB",  "ZSF3", "ZSF4", "FLAG"};  // 56

constexpr std::size_t columns = 3 + 64 + 64;

std::string column_name(std::size_t column) {
  if (column < 3) return std::array<const char*, 3>{"idx", "op", "cmd"}[column];
  return column < 67 ? "in" + std::to_string(column - 3) : "out" + std::to_string(column - 67);
}

/// Bytes of the file in a message: cut short, and nothing a terminal would obey.
std::string quoted(std::string_view text) {
  std::string safe = "'";
  for (const char c : text.substr(0, 24)) safe += c >= ' ' && c <= '~' ? c : '?';
  return safe + (text.size() > 24 ? "...'" : "'");
}

struct Row {
  std::string_view idx{}, op{};
  std::uint32_t command = 0;
  std::array<std::uint32_t, 64> in{}, out{};
};

std::optional<std::uint32_t> hexadecimal(std::string_view text) {
  std::uint32_t value = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value, 16);
  if (text.empty() || text.size() > 8 || error != std::errc{} || at != end) return std::nullopt;
  return value;
}

/// Takes the file apart line by line and field by field, and knows where it is.
class Reader {
 public:
  explicit Reader(std::string_view csv) : rest_(csv) {}

  bool next_line() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    text_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (text_.ends_with('\r')) text_.remove_suffix(1);
    at_ = 0;
    ++line_;
    return true;
  }

  /// The fields of this line; exactly `columns` of them, or an error.
  std::optional<Malformed> split(std::array<std::string_view, columns>& fields) {
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t end = std::min(text_.find(',', at_), text_.size());
      fields[i] = text_.substr(at_, end - at_);
      if (i + 1 < columns && end == text_.size()) {
        at_ = end;
        return here("expected a comma and " + column_name(i + 1) + ", got the end of the line");
      }
      at_ = end + 1;
    }
    if (at_ > text_.size()) return std::nullopt;
    return here("expected the end of the line after " + column_name(columns - 1));
  }

  [[nodiscard]] Malformed at(std::string_view field, std::string expected) const {
    return {line_, static_cast<std::size_t>(field.data() - text_.data()) + 1, std::move(expected)};
  }
  [[nodiscard]] Malformed here(std::string expected) const { return {line_, at_ + 1, std::move(expected)}; }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] bool is_blank() const { return text_.empty(); }

 private:
  std::string_view rest_, text_{};
  std::size_t line_ = 0, at_ = 0;
};

std::optional<Malformed> parse_header(Reader& reader) {
  std::array<std::string_view, columns> fields{};
  if (!reader.next_line()) return Malformed{1, 1, "expected a header row, got an empty file"};
  auto error = reader.split(fields);
  for (std::size_t i = 0; i < columns && fields[i].data() != nullptr; ++i) {
    if (fields[i] != column_name(i)) {
      return reader.at(fields[i],
                       "expected " + column_name(i) + " in the header row, got " + quoted(fields[i]));
    }
  }
  return error;
}

std::optional<Malformed> parse_row(Reader& reader, Row& row) {
  std::array<std::string_view, columns> fields{};
  if (auto error = reader.split(fields)) return error;
  row.idx = fields[0];
  row.op = fields[1];
  for (std::size_t i = 0; i < 2; ++i) {
    if (fields[i].empty() ||
        fields[i].find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz"
                                    "ABCDEFGHIJKLMNOPQRSTUVWXYZ-_") != std::string_view::npos) {
      return reader.at(fields[i], "expected a word in " + column_name(i) + ", got " + quoted(fields[i]));
    }
  }
  for (std::size_t i = 2; i < columns; ++i) {
    const auto value = hexadecimal(fields[i]);
    if (!value) {
      return reader.at(fields[i], "expected 1 to 8 hexadecimal digits in " + column_name(i) + ", got " +
                                      quoted(fields[i]));
    }
    (i == 2 ? row.command : i < 67 ? row.in[i - 3] : row.out[i - 67]) = *value;
  }
  return std::nullopt;
}

std::optional<Malformed> parse(std::string_view csv, std::vector<Row>& rows) {
  Reader reader(csv);
  if (auto error = parse_header(reader)) return error;
  while (reader.next_line()) {
    if (reader.is_blank() && reader.at_end()) break;
    rows.emplace_back();
    if (auto error = parse_row(reader, rows.back())) return error;
  }
  return std::nullopt;
}

Registers run(const Row& row) {
  Registers r;
  for (unsigned i = 0; i < 64; ++i) write(r, i, row.in[i]);
  if (row.op != "---") execute(r, row.command & 0x1ffffffu);
  return r;
}

std::string hex(std::uint32_t value) {
  std::array<char, 8> digits{};
  for (std::size_t i = 0; i < 8; ++i) digits[7 - i] = "0123456789abcdef"[(value >> (4 * i)) & 15u];
  return {digits.data(), digits.size()};
}

}  // namespace

std::string_view register_name(unsigned number) {
  assert(number < 64);
  return names[number];
}

std::string Malformed::message() const {
  return "line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + expected;
}

CheckOutcome check_csv(std::string_view csv, std::ostream& out, bool all) {
  constexpr std::size_t shown_by_default = 20;
  CheckOutcome outcome;
  std::vector<Row> rows;
  outcome.malformed = parse(csv, rows);
  if (outcome.malformed) return outcome;

  std::size_t differences = 0;
  for (const Row& row : rows) {
    const Registers after = run(row);
    bool same = true;
    for (unsigned i = 0; i < 64; ++i) {
      const std::uint32_t got = read(after, i);
      if (got == row.out[i]) continue;
      same = false;
      if (++differences > shown_by_default && !all) continue;
      out << "row " << row.idx << ' ' << row.op << ": register " << names[i] << " got " << hex(got)
          << " expected " << hex(row.out[i]) << '\n';
    }
    ++(same ? outcome.passed : outcome.failed);
  }
  if (differences > shown_by_default && !all) {
    out << differences - shown_by_default << " more differences (--all prints them)\n";
  }
  out << outcome.passed << " passed, " << outcome.failed << " failed\n";
  return outcome;
}

}  // namespace gte
