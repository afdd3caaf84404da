#pragma once
// Runs register vectors: rows of "these 64 registers, this command, those 64
// registers", as captured on a console.

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "gte/registers.h"

namespace gte {

/// The name of register 0..63 as documents write it: "VXY0", "SXYP", "R11R12", "FLAG".
std::string_view register_name(unsigned number);

/// What is wrong with a vector file, and where; both counted from 1, the column in bytes.
struct Malformed {
  std::size_t line = 1, column = 1;
  std::string expected;  ///< "expected 1 to 8 hexadecimal digits in in7, got 'xyz'"
  [[nodiscard]] std::string message() const;
};

struct CheckOutcome {
  std::size_t passed = 0, failed = 0;    ///< rows
  std::optional<Malformed> malformed{};  ///< then nothing was run and nothing printed

  /// 0 all passed, 1 a row differs, 2 malformed.
  [[nodiscard]] int exit_status() const { return malformed ? 2 : failed != 0 ? 1 : 0; }
};

/// Runs every row of `csv`, the text of a vector file:
///     idx,op,cmd,in0..in63,out0..out63     header row required; hexadecimal without prefix; LF or CRLF
/// Each row writes in0..in63 in ascending order with all side effects, executes the low 25 bits of cmd (op
/// "---": nothing), and compares what registers 0..63 read with out0..out63. Prints to `out`, one line for
/// each register that differs, at most 20 unless `all`, and last the count of rows:
///     row IDX OP: register NAME got X expected Y
///     N passed, N failed
/// Any bytes are accepted as input; a malformed file is a result, never a crash. The whole file is parsed
/// before any row is run.
CheckOutcome check_csv(std::string_view csv, std::ostream& out, bool all = false);

}  // namespace gte
