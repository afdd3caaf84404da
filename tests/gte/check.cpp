#include "gte/check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "gte/commands.h"
#include "tests/gte/random_registers.h"

namespace {

std::string header() {
  std::ostringstream out;
  out << "idx,op,cmd";
  for (const char* side : {"in", "out"}) {
    for (int i = 0; i < 64; ++i) out << ',' << side << i;
  }
  out << '\n';
  return out.str();
}

/// A row that passes but for the first `wrong` registers, which are off by one bit.
std::string row(int idx, std::string_view op, std::uint32_t command, unsigned wrong = 0,
                const char* end = "\n") {
  tests::Random random(static_cast<std::uint64_t>(idx));
  std::ostringstream out;
  out << idx << ',' << op << ',' << std::hex << command;
  gte::Registers r;
  for (unsigned i = 0; i < 64; ++i) {
    const std::uint32_t v = random.hostile_word();
    gte::write(r, i, v);
    out << ',' << v;
  }
  if (op != "---") gte::execute(r, command & 0x1ffffff);
  for (unsigned i = 0; i < 64; ++i) out << ',' << (gte::read(r, i) ^ (i < wrong ? 1u : 0u));
  out << end;
  return out.str();
}

struct Ran {
  gte::CheckOutcome outcome;
  std::string text;
};
Ran check(const std::string& csv, bool all = false) {
  std::ostringstream out;
  gte::CheckOutcome outcome = gte::check_csv(csv, out, all);
  return {outcome, out.str()};
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_SUITE("gte") {
  TEST_CASE("a vector file whose rows all agree passes, and the count is the last line") {
    const Ran ran =
        check(header() + row(1, "RTPS", 0x4a180001) + row(2, "NCDT", 0x0f80416) + row(3, "---", 0));
    CHECK(ran.outcome.exit_status() == 0);
    CHECK(ran.text == "3 passed, 0 failed\n");
  }

  TEST_CASE("a vector file may have CRLF line ends, and none at its end") {
    std::string csv = header();
    csv.back() = '\r';
    csv.push_back('\n');
    CHECK(check(csv + row(1, "SQR", 0x0a00428, 0, "\r\n") + row(2, "SQR", 0x0a00428, 0, "")).outcome.passed ==
          2);
  }

  TEST_CASE("a row that differs is named with its register, what was got and what was expected") {
    const Ran ran = check(header() + row(7, "---", 0, 1));
    CHECK(ran.outcome.exit_status() == 1);
    CHECK(ran.text.rfind("row 7 ---: register VXY0 got ", 0) == 0);
    CHECK(ran.text.find("\n0 passed, 1 failed\n") != std::string::npos);
  }

  TEST_CASE("at most 20 differences are printed unless all are asked for") {
    const std::string csv = header() + row(1, "---", 0, 30);
    CHECK(lines(check(csv).text) == 22);
    CHECK(check(csv).text.find("10 more differences") != std::string::npos);
    CHECK(lines(check(csv, true).text) == 31);
  }

  TEST_CASE("a malformed vector file prints nothing and says line, column and what was expected") {
    struct {
      std::string csv, message;
    } const files[] = {
        {"", "line 1, column 1: expected a header row, got an empty file"},
        {"index,op\n", "line 1, column 1: expected idx in the header row, got 'index'"},
        {"idx,op\n", "line 1, column 7: expected a comma and cmd, got the end of the line"},
        {header() + "1,RTPS,xyz", "line 2, column 11: expected a comma and in0, got the end of the line"},
        {header() + "1,RTPS,0", "line 2, column 9: expected a comma and in0, got the end of the line"},
        {header() + row(1, "---", 0, 0, ",0\n"), "expected the end of the line after out63"},
        {header() + "\n" + row(1, "---", 0),
         "line 2, column 1: expected a comma and op, got the end of the line"},
    };
    for (const auto& file : files) {
      const Ran ran = check(file.csv);
      CHECK(ran.outcome.exit_status() == 2);
      CHECK(ran.text.empty());
      REQUIRE(ran.outcome.malformed);
      CHECK(ran.outcome.malformed->message().find(file.message) != std::string::npos);
    }
  }

  TEST_CASE("a field that is no number of up to 8 hexadecimal digits is refused") {
    for (const char* bad : {"", "g", "0x1", "123456789", "-1", " 1", "1 "}) {
      std::string csv = header() + row(1, "---", 0);
      const std::size_t at = csv.find("---,") + 4;
      csv = csv.substr(0, at).append(bad).append(csv.substr(csv.find(',', at)));
      const Ran ran = check(csv);
      REQUIRE(ran.outcome.malformed);
      CHECK(ran.outcome.malformed->line == 2);
      CHECK(ran.outcome.malformed->column == 7);
      CHECK(ran.outcome.malformed->expected.find("in cmd") != std::string::npos);
    }
  }

  TEST_CASE("any bytes are an answer, not a crash") {
    tests::Random random(9);
    const std::string good = header() + row(1, "RTPS", 1) + row(2, "MVMVA", 0x12);
    for (int i = 0; i < 3000; ++i) {
      std::string csv = good.substr(0, random.below(static_cast<std::uint32_t>(good.size()) + 1));
      for (std::uint32_t n = random.below(4); n > 0 && !csv.empty(); --n) {
        csv[random.below(static_cast<std::uint32_t>(csv.size()))] = static_cast<char>(random.word());
      }
      const Ran ran = check(csv);
      CHECK(ran.outcome.malformed.has_value() == ran.text.empty());
    }
  }
}
