#include "app/commands/without_depth.h"

#include <cstdio>

namespace app {

using scene::WithoutDepth;

base::Result<void> check_without_depth(const std::string& source, const scene::Knobs& knobs,
                                       bool has_buckets) {
  if (has_buckets || knobs.visibility != scene::Visibility::zbuffer ||
      knobs.without_depth != WithoutDepth::bucket)
    return {};
  return base::fail("--without-depth bucket: " + source +
                    " has no buckets; expected error or list-order, or a RAM image with --table");
}

base::Result<void> judge_without_depth(const std::string& source, const scene::Knobs& knobs,
                                       const dump::ReplayEnd& end) {
  if (end.polygons_without_depth == 0) return {};
  const std::string found = source + ": " + std::to_string(end.polygons_without_depth) +
                            " polygons without depth, the first is command " +
                            std::to_string(end.first_frame) + ":" +
                            std::to_string(end.first_without_depth + 1);
  if (knobs.without_depth == WithoutDepth::error) {
    return base::fail(
        found + "; --without-depth list-order draws them, otter record --annotate writes depths",
        base::Exit::failed);
  }
  std::fprintf(stderr, "otter: %s: drawn in list order\n", found.c_str());
  return {};
}

}  // namespace app
