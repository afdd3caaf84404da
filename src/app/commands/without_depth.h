#pragma once
// --without-depth, for what comes from outside: dumps and RAM images may hold polygons that bring no depth.

#include <string>

#include "base/result.h"
#include "dump/dump.h"
#include "scene/knobs.h"

namespace app {

/// What foreign lists do unless told otherwise: one polygon without depth must not refuse the whole picture.
inline constexpr auto foreign_without_depth = scene::WithoutDepth::list_order;

/// Before drawing. Error (exit 2): buckets are wanted, and `source` has none.
base::Result<void> check_without_depth(const std::string& source, const scene::Knobs& knobs,
                                       bool has_buckets);

/// After it: one line on stderr that counts the polygons drawn without depth. Error (exit 1): with
/// --without-depth error.
base::Result<void> judge_without_depth(const std::string& source, const scene::Knobs& knobs,
                                       const dump::ReplayEnd& end);

}  // namespace app
