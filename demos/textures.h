#pragma once
// Textures painted by rule: every demo makes its own, so the project carries no picture files.

#include <cstdint>
#include <functional>
#include <string>

#include "scene/world.h"

namespace demos {

/// A number 0..1 that looks random but depends on its arguments alone.
double grain(int x, int y, int seed);

/// Smooth noise 0..1 over the unit square that repeats after 1: `cells` hills each way, three octaves.
double clouds(double u, double v, int cells, int seed);

/// A colour made of another: 0 black, 1 unchanged, above 1 towards white.
scene::Rgba8 shaded(scene::Rgb8 colour, double light);
scene::Rgba8 mixed(scene::Rgba8 from, scene::Rgba8 to, double t);

/// A picture of size x size: paint(x, y) for every texel.
scene::Texture painted(std::string name, int size, const std::function<scene::Rgba8(int x, int y)>& paint);

scene::Texture wooden_crate();  ///< planks, a frame and a diagonal, nailed
scene::Texture metal_crate();   ///< plates, rivets, a yellow and black warning band
scene::Texture bricks();        ///< repeats
scene::Texture planks();        ///< floor boards; repeats
scene::Texture stone_tiles();   ///< two greys, worn; repeats
scene::Texture plaster();       ///< pale wall with a dado; repeats in u

}  // namespace demos
