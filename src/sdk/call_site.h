#pragma once
// Where in the program's source a call came from.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sdk {

/// An instruction of the program, the one after a call; nullptr: not known. A function of the SDK takes it
/// with
/// __builtin_return_address(0).
using CallSite = const void*;

/// "main.c:42" for each, by the program's debug information (binutils' addr2line); "00401A2Ch" where there is
/// none.
std::vector<std::string> describe(std::span<const CallSite> sites);

/// Of the frames of a call stack, innermost first: the first that lies in the program's own source.
std::string describe_first_in_program(std::span<const CallSite> frames);

/// Hardware's way to write an address: "41A2C0h".
std::string hex(std::uint32_t address);

}  // namespace sdk
