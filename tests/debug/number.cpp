// The one number of commands, as text.

#include "debug/number.h"

#include <doctest/doctest.h>

TEST_SUITE("debug") {
  TEST_CASE("a number is frame, command and, where there is one, bucket, with colons between them") {
    CHECK(debug::to_text({.frame = 3, .command = 17}) == "3:17");
    CHECK(debug::to_text({.frame = 3, .command = 17, .bucket = 512}) == "3:17:512");
    CHECK(debug::parse_number("3:17") == debug::Number{.frame = 3, .command = 17});
    CHECK(debug::parse_number("3:17:512") == debug::Number{.frame = 3, .command = 17, .bucket = 512});
    CHECK(debug::parse_number("0:0") == debug::Number{.frame = 0, .command = 0});
  }

  TEST_CASE("anything else is no number") {
    for (const auto* text : {"", ":", "3", "3:", ":3", "3:17:", "3:17:5:6", "3:17x", " 3:17", "-1:2", "3.1:2",
                             "99999999999999999999:1", "1:1:4294967296"}) {
      CAPTURE(text);
      CHECK_FALSE(debug::parse_number(text));
    }
  }
}
