#pragma once
// What the controllers say at each vertical blank: from a script, from keys, or from what was recorded of
// either.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "app/window/pad_keys.h"
#include "base/result.h"

namespace sdk {

/// One controller; bits of PadButton.
using PadState = app::PadHeld;

/// What is held from a frame on.
using PadScript = std::map<std::uint32_t, PadState>;

/// "30:UP+X,60:,90:LX=0+CIRCLE": from frame 30 on UP and CROSS, from 60 on nothing, from 90 on the left stick
/// at its left end and CIRCLE. Buttons UP DOWN LEFT RIGHT TRIANGLE CIRCLE CROSS (X) SQUARE L1 L2 L3 R1 R2 R3
/// START SELECT; sticks LX LY RX RY = 0..255 make the controller an analog one, for good. Error: names the
/// part that cannot be read.
base::Result<PadScript> parse_pad_script(std::string_view text);

/// The same words again.
std::string to_text(const PadScript& script);

/// What is held at `frame`.
PadState at_frame(const PadScript& script, std::uint32_t frame);

/// Bytes of a controller's answer as a program sees them: 4 of a digital one, 8 of an analog one.
struct PadAnswer {
  std::array<std::uint8_t, 8> bytes{};
  std::size_t count = 0;
};
PadAnswer answer(const PadState& pad);
/// No controller.
PadAnswer no_answer();

}  // namespace sdk
