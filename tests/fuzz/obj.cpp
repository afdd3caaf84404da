// Any bytes as an OBJ; what stands behind a line "#MTL" is read as its material library too.

#include "load/obj.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include "load/pictures.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto cut = text.find("#MTL\n");
  const load::Source source{"fuzz.obj", "/nonexistent"};
  (void)load::parse_obj(text.substr(0, cut), source);
  if (cut == std::string::npos) return 0;
  load::LoadedScene scene;
  load::Pictures pictures(source, scene);
  std::map<std::string, load::ObjMaterial, std::less<>> materials;
  load::parse_mtl(text.substr(cut), pictures, materials);
  return 0;
}
