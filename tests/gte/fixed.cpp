#include "gte/fixed.h"

#include <doctest/doctest.h>

#include "gte/registers.h"

TEST_SUITE("gte") {
  TEST_CASE("a fixed-point literal is rounded to the nearest raw value, halves away from zero") {
    static_assert(gte::S3_12::of(1.0).raw == 0x1000);
    static_assert(gte::S3_12::of(-8.0).raw == -0x8000);
    static_assert(gte::S15_16::of(160).raw == 160 << 16);
    static_assert(gte::S7_8::of(0.001953125).raw == 1);  // half of 1/256
    static_assert(gte::S7_8::of(-0.001953125).raw == -1);
    static_assert(gte::S27_4::of(255).raw == 0xff0);
    CHECK(gte::S3_12::of(0.3333).raw == 1365);
  }

  TEST_CASE("a fixed-point number floors toward minus infinity and compares by value") {
    CHECK(gte::S15_16::of(-0.5).floor() == -1);
    CHECK(gte::S15_16::of(2.75).floor() == 2);
    CHECK(gte::S15_16::of(2.75).to_double() == 2.75);
    CHECK(gte::S3_12::of(-1) < gte::S3_12::of(0.5));
  }
}
