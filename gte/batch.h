#pragma once
// The batch door: the same results for arrays. Every value here is, bit for bit, what the
// single command would leave in its register, for every input and every sf and lm; tests/gte
// holds each dispatch target to that.
//
// All functions take the set-up registers (matrices, translations, offsets, H, DQA, DQB, ZSF, colours) from
// `setup`, which they do not change. Outputs are plain arrays that the caller owns; a null pointer means "not
// wanted", and what is not wanted is not computed. Any length, 0 included, and any alignment the type allows.
// Outputs must not overlap the inputs or each other.
//
// Not here: the commands nobody runs on arrays (OP, SQR, GPF, GPL, INTPL, CDP, CC, DCPL); use commands.h.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gte/commands.h"
#include "gte/registers.h"

namespace gte {

/// What RTPS makes of each vertex; arrays as long as the input.
struct ProjectOut {
  ScreenXy* sxy = nullptr;        ///< SXY2
  std::uint16_t* sz = nullptr;    ///< SZ3, eye units
  std::uint32_t* flag = nullptr;  ///< FLAG, as RTPS on this vertex leaves it
  std::int16_t* ir0 = nullptr;    ///< IR0, depth cue, 0..1000h
  /// View-space z, unsigned 20.12: the sum before >> 12, limited to 0..FFFFFFFFh.
  std::uint32_t* z_20_12 = nullptr;
  /// Bits 8..15 of OFX + q*IR1, whose bits 16.. are SX; also when SX was limited.
  std::uint8_t* fraction_x = nullptr;
  std::uint8_t* fraction_y = nullptr;  ///< the same of OFY + q*IR2
};

/// RTPS for every vertex. Reads RT, TR, OFX, OFY, H, DQA, DQB of `setup`.
void project(const Registers& setup, std::span<const Vertex> in, const ProjectOut& out,
             Command c = sdk::rtps);

/// What RTPT, NCLIP and AVSZ3 make of each triangle; `vertex` arrays have three entries a triangle, the
/// others one. NCLIP has no FLAG here: between screen positions of RTPT it cannot overflow.
struct TriangleOut {
  ScreenXy* sxy = nullptr;              ///< per vertex: SXY0..2
  std::uint16_t* sz = nullptr;          ///< per vertex: SZ1..3
  std::uint32_t* flag = nullptr;        ///< FLAG after RTPT
  std::int16_t* ir0 = nullptr;          ///< IR0, of the last vertex
  std::int32_t* mac0 = nullptr;         ///< MAC0 after NCLIP: twice the signed area
  std::uint16_t* otz = nullptr;         ///< OTZ
  std::uint32_t* avsz3_flag = nullptr;  ///< FLAG after AVSZ3
};

/// RTPT, NCLIP and AVSZ3 for every three vertices; `in` holds a multiple of three. Reads what project()
/// reads, and ZSF3.
void project_triangles(const Registers& setup, std::span<const Vertex> in, const TriangleOut& out,
                       Command c = sdk::rtpt);

/// What NCLIP and AVSZ3 or AVSZ4 make of each face.
struct FaceOut {
  std::int32_t* mac0 = nullptr;         ///< MAC0 after NCLIP of the first three vertices
  std::uint32_t* nclip_flag = nullptr;  ///< FLAG after NCLIP
  std::uint16_t* otz = nullptr;         ///< OTZ after AVSZ3 or AVSZ4
  std::uint32_t* avsz_flag = nullptr;   ///< FLAG after AVSZ3 or AVSZ4
};

/// NCLIP and AVSZ3 for triangles of a mesh whose vertices project() has done once: three indices a face into
/// `sxy` and `sz`, all below their length. Reads ZSF3.
void measure_triangles(const Registers& setup, std::span<const ScreenXy> sxy,
                       std::span<const std::uint16_t> sz, std::span<const std::uint32_t> indices,
                       const FaceOut& out);

/// The same for quads: four indices a face, NCLIP of the first three, AVSZ4 of all. Reads ZSF4.
void measure_quads(const Registers& setup, std::span<const ScreenXy> sxy, std::span<const std::uint16_t> sz,
                   std::span<const std::uint32_t> indices, const FaceOut& out);

struct ColourOut {
  Colour* rgb = nullptr;          ///< RGB2; code of RGBC
  std::uint32_t* flag = nullptr;  ///< FLAG
};

enum class Light : std::uint8_t { ncs, nccs, ncds };

/// NCS, NCCS or NCDS for every normal. `rgbc` gives each its colour, `ir0` its depth cue (NCDS); an empty one
/// means that of `setup` for all. Reads LLM, LCM, BK, and FC (NCDS) of `setup`.
void light(const Registers& setup, Light kind, std::span<const Vertex> normals, std::span<const Colour> rgbc,
           std::span<const std::int16_t> ir0, const ColourOut& out, Command c = sdk::ncds);

/// DPCS for every colour; `ir0` one each, or empty for that of `setup`. Reads FC.
void cue(const Registers& setup, std::span<const Colour> rgbc, std::span<const std::int16_t> ir0,
         const ColourOut& out, Command c = sdk::dpcs);

/// DPCT for every three colours (RGB0, RGB1, RGB2), whose count is a multiple of three; `ir0` one for three.
/// out.rgb has three entries and out.flag one for each. CODE comes from RGBC of `setup`. Reads FC.
void cue_triples(const Registers& setup, std::span<const Colour> rgb, std::span<const std::int16_t> ir0,
                 const ColourOut& out, Command c = sdk::dpct);

struct VectorOut {
  std::array<std::int32_t*, 3> mac{};  ///< MAC1..3
  std::array<std::int16_t*, 3> ir{};   ///< IR1..3
  std::uint32_t* flag = nullptr;       ///< FLAG
};

/// MVMVA for every vector, which takes the place of the one `c` selects (V0..V2 or
/// IR1..3). Reads what `c` selects.
void multiply(const Registers& setup, Command c, std::span<const Vertex> in, const VectorOut& out);

// ---- dispatch

/// The instruction set in use: "AVX-512", "AVX2", "SSE4", or "scalar", which is
/// the single commands in a loop.
const char* batch_target();

/// Those this processor and this build offer, fastest first; the last is "scalar".
std::vector<const char*> batch_targets();

/// Uses the one named instead of the fastest, until called again; an unknown name changes nothing and returns
/// false. Not for use while another thread is inside the batch door: it is for tests and benchmarks.
bool use_batch_target(std::string_view name);

}  // namespace gte
