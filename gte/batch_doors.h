#pragma once
// Inside the batch door: one table of functions per instruction set, and the plain
// one that all others must equal.

#include <cstddef>
#include <cstdint>

#include "gte/batch.h"

namespace gte {

// The functions of batch.h, which only choose between these.
struct ProjectDoors {
  void (*project)(const Registers&, std::span<const Vertex>, const ProjectOut&, Command);
  void (*project_triangles)(const Registers&, std::span<const Vertex>, const TriangleOut&, Command);
};
struct LightDoors {
  void (*light)(const Registers&, Light, std::span<const Vertex>, std::span<const Colour>,
                std::span<const std::int16_t>, const ColourOut&, Command);
  void (*cue)(const Registers&, std::span<const Colour>, std::span<const std::int16_t>, const ColourOut&,
              Command);
  void (*cue_triples)(const Registers&, std::span<const Colour>, std::span<const std::int16_t>,
                      const ColourOut&, Command);
  void (*multiply)(const Registers&, Command, std::span<const Vertex>, const VectorOut&);
};

/// The single commands in a loop: what all others must equal.
extern const ProjectDoors plain_project_doors;
extern const LightDoors plain_light_doors;

/// Those of an instruction set, one bit as Highway numbers it; null where this build has none.
const ProjectDoors* project_doors(std::int64_t target);
const LightDoors* light_doors(std::int64_t target);

/// A pointer into the same array further on; null stays null.
template <class T>
T* advance(T* array, std::size_t by) {
  return array == nullptr ? nullptr : array + by;
}

/// array[i] = value where the array is wanted.
template <class T, class U>
void put(T* array, std::size_t i, U value) {
  if (array != nullptr) array[i] = static_cast<T>(value);
}

}  // namespace gte
