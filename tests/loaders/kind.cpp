// What a file is: its first bytes first, then its name.

#include <doctest/doctest.h>

#include <string>

#include "base/file_kind.h"

TEST_SUITE("loaders") {
  using base::FileKind, base::kind_of;

  TEST_CASE("the first bytes say what a file is, whatever its name") {
    struct Row {
      std::string bytes;
      FileKind kind;
    };
    const std::string zero(1, '\0');
    for (const auto& row :
         {Row{"PSXGPUDUMPv1r1" + zero + zero, FileKind::dump},
          Row{"PSXGPUDUMPv1" + zero + zero, FileKind::dump}, Row{"\x28\xB5\x2F\xFD", FileKind::dump},
          Row{"\xFD"
              "7zXZ" +
                  zero,
              FileKind::dump},
          Row{"<X3D>", FileKind::x3d}, Row{"\xEF\xBB\xBF\n <?xml", FileKind::x3d},
          Row{"v 0 0 0\n", FileKind::obj}, Row{"# made by hand\nv 0 0 0\n", FileKind::obj}}) {
      CAPTURE(row.bytes);
      for (const char* name : {"name", "name.obj", "name.x3d", "name.psxgpu"})
        CHECK(kind_of(row.bytes, name) == row.kind);
    }
  }

  TEST_CASE("where the bytes do not say, the extension does, in any case") {
    CHECK(kind_of("# nothing yet", "M.OBJ") == FileKind::obj);
    CHECK(kind_of("", "scene.X3d") == FileKind::x3d);
    CHECK(kind_of("", "frame.PSXGPU") == FileKind::dump);
    CHECK(kind_of("", "frame.psxgpu.zst") == FileKind::dump);
    CHECK(kind_of("", "frame") == FileKind::unknown);
    CHECK(kind_of("hello", "frame.txt") == FileKind::unknown);
  }
}
