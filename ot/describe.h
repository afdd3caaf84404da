#pragma once
// Commands of both GPU ports in words, for listings.

#include <cstdint>
#include <span>
#include <string>

namespace ot {

/// One line about one command, without its opcode: "triangle, gouraud (0,0) ff0000 (8,0) 00ff00 (0,8)
/// 0000ff". `words` are those of CommandStream::words(); `length` is the number of all its words (the
/// vertices of a long polyline that are not among `words` are counted, not shown). Numbers are decimal;
/// colours, pages and CLUTs are hexadecimal.
std::string describe(std::span<const std::uint32_t> words, std::uint64_t length);

/// One line about a word of GP1: "display from 0,240".
std::string describe_control(std::uint32_t word);

/// An address of main RAM as all of Otter writes it: "0801F4h", six digits at least.
std::string address_text(std::uint32_t address);

}  // namespace ot
