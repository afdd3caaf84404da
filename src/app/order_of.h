#pragma once
// What decides between two polygons of a frame, as the visibility mode has it: what truth is held against.

#include "inspect/report.h"
#include "scene/knobs.h"

namespace app {

[[nodiscard]] constexpr inspect::Order order_of(scene::Visibility visibility) {
  switch (visibility) {
    case scene::Visibility::ot:
    case scene::Visibility::sorted:
      return inspect::Order::list;
    case scene::Visibility::bsp:
      return inspect::Order::exact;
    case scene::Visibility::zbuffer:
      return inspect::Order::depth;
  }
  return inspect::Order::list;
}

}  // namespace app
