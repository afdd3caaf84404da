// The SDK's macros and functions on the coprocessor's registers.

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "sdk/console.h"
#include "sdk/include/inline_c.h"
#include "sdk/include/psxgpu.h"
#include "sdk/include/psxgte.h"

TEST_SUITE("sdk") {
  namespace {

  struct Fresh {
    Fresh() { sdk::the_console().gte = {}; }
  };

  /// How far `value` / 4096 is from `expected`, in 1/4096.
  double error(int value, double expected) { return std::abs(value - 4096 * expected); }

  constexpr double pi = 3.14159265358979323846;

  }  // namespace

  TEST_CASE_FIXTURE(Fresh, "gte_ldv3 loads three vectors, their z sign-extended") {
    const SVECTOR v[3] = {{1, -2, 3, 0}, {4, 5, -6, 0}, {7, 8, 9, 0}};
    gte_ldv3(&v[0], &v[1], &v[2]);
    CHECK(sdk::the_console().gte.v[0] == gte::Vertex{1, -2, 3, 0});
    CHECK(sdk::the_console().gte.v[1] == gte::Vertex{4, 5, -6, 0});
    CHECK(sdk::the_console().gte.v[2] == gte::Vertex{7, 8, 9, 0});
  }

  TEST_CASE_FIXTURE(Fresh, "the loads of arrays take what the loads of one take") {
    const SVECTOR v[3] = {{1, -2, 3, 0}, {4, 5, -6, 0}, {7, 8, 9, 0}};
    gte_ldv3(&v[0], &v[1], &v[2]);
    const auto expected = sdk::the_console().gte;
    sdk::the_console().gte = {};
    gte_ldv3c(v);
    CHECK(sdk::the_console().gte == expected);
    struct {
      SVECTOR v;
      uint32_t colour;
    } with_colour[3] = {{v[0], 1}, {v[1], 2}, {v[2], 3}};
    sdk::the_console().gte = {};
    gte_ldv3c_vertc(with_colour);
    CHECK(sdk::the_console().gte == expected);
  }

  TEST_CASE_FIXTURE(Fresh, "matrices go to their registers and come back") {
    const MATRIX m{{{1, 2, 3}, {4, 5, 6}, {7, 8, -9}}, {10, 11, 12}};
    MATRIX read{};
    gte_SetRotMatrix(&m);
    gte_SetTransMatrix(&m);
    gte_ReadRotMatrix(&read);
    CHECK(read.m[2][2] == -9);
    CHECK(read.m[1][0] == 4);
    CHECK(read.t[2] == 12);
    gte_SetLightMatrix(&m);
    CHECK(sdk::the_console().gte.llm[2][1].raw == 8);
    gte_SetColorMatrix(&m);
    CHECK(sdk::the_console().gte.lcm[0][2].raw == 3);
  }

  TEST_CASE_FIXTURE(Fresh, "colours of the macros are eight bits, those of the registers twelve") {
    gte_SetBackColor(1, 2, 255);
    CHECK(sdk::the_console().gte.bk[2].raw == 255 << 4);
    gte_SetFarColor(16, 0, 0);
    CHECK(sdk::the_console().gte.fc[0].raw == 256);
  }

  TEST_CASE_FIXTURE(Fresh, "the screen offset is kept in 16.16 and read back in pixels") {
    int x = 0, y = 0;
    gte_SetGeomOffset(160, static_cast<uint32_t>(-120));
    gte_ReadGeomOffset(&x, &y);
    CHECK(x == 160);
    CHECK(y == -120);
  }

  TEST_CASE_FIXTURE(Fresh, "gte_stsxy3_gt3 stores where a textured Gouraud triangle has its vertices") {
    POLY_GT3 packet{};
    gte_ldsxy3(0x00020001, 0x00040003, 0x00060005);
    gte_stsxy3_gt3(&packet);
    CHECK(packet.x0 == 1);
    CHECK(packet.y1 == 4);
    CHECK(packet.x2 == 5);
    CHECK(packet.u0 == 0);
  }

  TEST_CASE_FIXTURE(Fresh, "gte_strgb3_g3 stores where a Gouraud triangle has its colours") {
    POLY_G3 packet{};
    const CVECTOR colours[3] = {{1, 2, 3, 0x30}, {4, 5, 6, 0}, {7, 8, 9, 0}};
    gte_ldrgb3c(colours);
    gte_strgb3_g3(&packet);
    CHECK(packet.r0 == 1);
    CHECK(packet.g1 == 5);
    CHECK(packet.b2 == 9);
    CHECK(packet.code == 0x30);
  }

  TEST_CASE_FIXTURE(Fresh, "differences of screen positions, into words and into halfwords") {
    const DVECTOR a{5, -3}, b{7, 2};
    VECTOR l{};
    DVECTOR d{};
    gte_subdvl(&a, &b, &l);
    CHECK(l.vx == -2);
    CHECK(l.vy == -5);
    gte_adddvd(&a, &b, &d);
    CHECK(d.vx == 12);
    CHECK(d.vy == -1);
  }

  TEST_CASE_FIXTURE(Fresh, "gte_FlipRotMatrixX negates the first row alone") {
    const MATRIX m{{{1, -2, 3}, {4, 5, 6}, {7, 8, 9}}, {}};
    MATRIX read{};
    gte_SetRotMatrix(&m);
    gte_FlipRotMatrixX();
    gte_ReadRotMatrix(&read);
    CHECK(read.m[0][0] == -1);
    CHECK(read.m[0][1] == 2);
    CHECK(read.m[0][2] == -3);
    CHECK(read.m[1][0] == 4);
  }

  TEST_CASE_FIXTURE(Fresh, "gte_rtps puts a vertex where perspective has it, and its depth beside it") {
    const MATRIX m{{{ONE, 0, 0}, {0, ONE, 0}, {0, 0, ONE}}, {0, 0, 500}};
    const SVECTOR v{51, -26, 0, 0};
    InitGeom();
    gte_SetGeomOffset(160, 120);
    gte_SetRotMatrix(&m);
    gte_SetTransMatrix(&m);
    gte_ldv0(&v);
    gte_rtps();
    DVECTOR xy{};
    gte_stsxy(&xy);
    CHECK(xy.vx == 160 + 32);  // 51 * 320 / 500 = 32.64, rounded down
    CHECK(xy.vy == 120 - 17);
    int z = 0;
    gte_stsz(&z);
    CHECK(z == 500);
  }

  TEST_CASE("packets are as long as the words of their commands and a tag") {
    CHECK(sizeof(POLY_F3) == 20);
    CHECK(sizeof(POLY_FT3) == 32);
    CHECK(sizeof(POLY_G3) == 28);
    CHECK(sizeof(POLY_GT3) == 40);
    CHECK(sizeof(POLY_F4) == 24);
    CHECK(sizeof(POLY_FT4) == 40);
    CHECK(sizeof(POLY_G4) == 36);
    CHECK(sizeof(POLY_GT4) == 52);
    CHECK(sizeof(LINE_G4_T) == 36);
    CHECK(sizeof(SPRT) == 20);
    CHECK(sizeof(DR_ENV) == 36);
  }

  TEST_CASE("texture page and CLUT words hold their corners in VRAM") {
    CHECK(getTPage(2, 1, 640, 256) == (10 | 16 | 1 << 5 | 2 << 7));
    CHECK(getClut(640, 480) == (480 << 6 | 40));
  }

  TEST_CASE("isin and icos are within 13/4096 of the sine for every angle, and exact at the quarters") {
    for (int a = -4096; a <= 8192; ++a) {
      REQUIRE(error(isin(a), std::sin(a * pi / 2048)) < 13);
      REQUIRE(error(icos(a), std::cos(a * pi / 2048)) < 13);
    }
    CHECK(isin(0) == 0);
    CHECK(isin(1024) == 4096);
    CHECK(icos(2048) == -4096);
    CHECK(hisin(32768) == 4096);
  }

  TEST_CASE("square roots round down") {
    CHECK(SquareRoot0(24) == 4);
    CHECK(SquareRoot0(25) == 5);
    CHECK(SquareRoot0(-1) == 0);
    CHECK(SquareRoot12(ONE) == ONE);
    CHECK(SquareRoot12(4 * ONE) == 2 * ONE);
  }

  TEST_CASE_FIXTURE(Fresh, "a quarter turn around z takes x to y") {
    SVECTOR turn{0, 0, ONE / 4, 0};
    MATRIX m{};
    RotMatrix(&turn, &m);
    VECTOR x{100, 0, 0}, out{};
    ApplyMatrixLV(&m, &x, &out);
    CHECK(out.vx == 0);
    CHECK(out.vy == 100);
  }

  TEST_CASE_FIXTURE(Fresh,
                    "RotMatrix leaves the registers alone, MulMatrix0 leaves its left matrix in them") {
    const MATRIX before{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}, {}};
    SVECTOR turn{100, 200, 300, 0};
    MATRIX m{}, read{}, product{};
    gte_SetRotMatrix(&before);
    RotMatrix(&turn, &m);
    gte_ReadRotMatrix(&read);
    CHECK(read.m[1][1] == 5);
    MATRIX unit{{{ONE, 0, 0}, {0, ONE, 0}, {0, 0, ONE}}, {}};
    MulMatrix0(&unit, &m, &product);
    gte_ReadRotMatrix(&read);
    CHECK(read.m[1][1] == ONE);
    CHECK(product.m[2][0] == m.m[2][0]);
  }

  TEST_CASE_FIXTURE(Fresh, "CompMatrixLV moves by the second translation turned by the first matrix") {
    MATRIX a{{{0, -ONE, 0}, {ONE, 0, 0}, {0, 0, ONE}}, {1, 2, 3}};
    MATRIX b{{{ONE, 0, 0}, {0, ONE, 0}, {0, 0, ONE}}, {10, 0, 0}}, out{};
    CompMatrixLV(&a, &b, &out);
    CHECK(out.t[0] == 1);
    CHECK(out.t[1] == 12);
    CHECK(out.t[2] == 3);
    CHECK(out.m[1][0] == ONE);
  }

  TEST_CASE_FIXTURE(Fresh, "VectorNormalS gives a length of 4096, within one in a hundred") {
    for (const VECTOR& v :
         {VECTOR{100, 0, 0}, VECTOR{300, -400, 1200}, VECTOR{1, 1, 1}, VECTOR{-32000, 10, 5}}) {
      VECTOR given = v;
      SVECTOR out{};
      VectorNormalS(&given, &out);
      const double length = std::hypot(out.vx, out.vy, out.vz);
      CHECK(std::abs(length - 4096) < 41);
    }
  }
}
