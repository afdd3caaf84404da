// The outside world fails: the disk is full, nobody reads, two write at once, someone presses Ctrl-C, a file
// is a bomb. Old files stay whole, the exit status tells, and memory stays bounded.

#include <doctest/doctest.h>
#include <fcntl.h>
#include <lzma.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "dump/compression.h"
#include "dump/dump.h"

namespace {

namespace fs = std::filesystem;

struct Ended {
  int status = -1;  ///< exit status; 128 + signal where one ended it
  std::uint64_t peak_bytes = 0;
  std::string err;
};

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder of its own for each case; processes run in it.
class Folder {
 public:
  fs::path path = fs::temp_directory_path() / ("otter_tests_faults_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Starts the program. `most_file_bytes`: what a file may grow to, as on a disk that is nearly full.
  [[nodiscard]] pid_t start(const std::vector<std::string>& words, rlim_t most_file_bytes = RLIM_INFINITY,
                            int out = -1) const {
    const std::string name = OTTER_PROGRAM;
    std::vector<char*> arguments{const_cast<char*>(name.c_str())};
    for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    std::signal(SIGPIPE, SIG_DFL);  // whatever this program does with it
    const rlimit limit{most_file_bytes, most_file_bytes};
    const int err = open((path / ".err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, 0);
    dup2(out >= 0 ? out : nothing, 1);
    dup2(err, 2);
    if (chdir(path.c_str()) != 0 || setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(99);
    execv(name.c_str(), arguments.data());
    _exit(98);
  }

  [[nodiscard]] Ended end(pid_t child) const {
    Ended ended;
    int status = 0;
    rusage usage{};
    if (wait4(child, &status, 0, &usage) != child) return ended;
    ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ended.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    ended.err = contents(path / ".err");
    return ended;
  }

  [[nodiscard]] Ended run(const std::vector<std::string>& words, rlim_t most = RLIM_INFINITY,
                          int out = -1) const {
    return end(start(words, most, out));
  }

  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
  }
  [[nodiscard]] bool has_leftovers() const {
    return std::any_of(fs::directory_iterator(path), fs::directory_iterator(), [](const auto& entry) {
      return entry.path().filename().string().find(".part") != std::string::npos;
    });
  }
};

bool is_one_line(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

constexpr std::uint64_t mib = std::uint64_t{1} << 20;

/// 2 MiB of main RAM with an end marker at address 0.
std::string empty_list() { return "\xff\xff\xff" + std::string(2 * mib - 3, '\0'); }

}  // namespace

TEST_SUITE("otter") {
  TEST_CASE("a disk that fills up is exit 1 and one line, and the file that was there stays whole") {
    const Folder folder;
    REQUIRE(folder.run({"record", "crates", "-o", "good.psxgpu"}).status == 0);
    folder.put("ram.bin", empty_list());
    const std::vector<std::vector<std::string>> writers{
        {"render", "crates", "-o", "old"},
        {"record", "crates", "-o", "old"},
        {"record", "crates", "--format", "v1", "-o", "old"},
        {"replay", "good.psxgpu", "--vram", "old"},
        {"inspect", "crates", "--json", "old"},
        {"inspect", "crates", "--heatmap", "old"},
        {"effects", "cyclic", "--json", "old"},
        {"cost", "cyclic", "--axes", "fog", "--rounds", "1", "--json", "old"},
        {"cost", "cyclic", "--axes", "fog", "--rounds", "1", "--csv", "old"},
        {"cost", "cyclic", "--axes", "fog", "--rounds", "1", "--html", "old"},
    };
    for (const auto& words : writers) {
      folder.put("old", "what was there");
      const auto ended = folder.run(words, 700);
      CAPTURE(words[0]);
      CAPTURE(ended.err);
      CHECK(ended.status == 1);
      CHECK(is_one_line(ended.err));
      CHECK(ended.err.find("old: cannot be written") != std::string::npos);
      CHECK(contents(folder.path / "old") == "what was there");
      CHECK_FALSE(folder.has_leftovers());
    }
  }

  TEST_CASE("a pipe that nobody reads any more ends the program at once and silently, as it ends cat") {
    const Folder folder;
    REQUIRE(folder.run({"record", "crates", "-o", "good.psxgpu"}).status == 0);
    for (const auto& words : std::vector<std::vector<std::string>>{{"list", "--long"},
                                                                   {"inspect", "crates", "--json", "-"},
                                                                   {"inspect", "crates"},
                                                                   {"effects", "crates"},
                                                                   {"effects", "crates", "--json", "-"},
                                                                   {"replay", "good.psxgpu", "--list"},
                                                                   {"render", "crates", "-o", "x.png"}}) {
      std::array<int, 2> ends{};
      REQUIRE(pipe(ends.data()) == 0);
      close(ends[0]);
      const auto ended = folder.run(words, RLIM_INFINITY, ends[1]);
      close(ends[1]);
      CAPTURE(words[0]);
      CAPTURE(ended.err);
      CHECK(ended.status == 128 + SIGPIPE);
      CHECK(ended.err.empty());
    }
  }

  TEST_CASE("instances that write the same file at once leave one whole file") {
    const std::vector<std::vector<std::string>> writers{
        {"render", "crates", "-o"}, {"record", "crates", "-o"}, {"inspect", "crates", "--json"}};
    for (auto words : writers) {
      const Folder folder;
      CAPTURE(words[0]);
      words.push_back("alone");
      REQUIRE(folder.run(words).status == 0);
      words.back() = "shared";
      std::vector<pid_t> children;
      for (int i = 0; i < 4; ++i) children.push_back(folder.start(words));
      for (const auto child : children) CHECK(folder.end(child).status == 0);
      CHECK(contents(folder.path / "shared") == contents(folder.path / "alone"));
      CHECK_FALSE(folder.has_leftovers());
    }
  }

  TEST_CASE("Ctrl-C in a long inspection ends it with exit 130 and a report of the frames that were done") {
    const Folder folder;
    std::array<int, 2> ends{};
    REQUIRE(pipe(ends.data()) == 0);
    const auto child = folder.start({"inspect", "crates", "--frames", "0..1000000", "--json", "part.json"},
                                    RLIM_INFINITY, ends[1]);
    close(ends[1]);
    // The pipe fills up unless read; once something came, a frame is done and the handler stands.
    std::array<char, 4096> some{};
    bool asked = false;
    while (read(ends[0], some.data(), some.size()) > 0) {
      if (!std::exchange(asked, true)) kill(child, SIGINT);
    }
    close(ends[0]);
    const auto ended = folder.end(child);
    CAPTURE(ended.err);
    CHECK(ended.status == 130);
    CHECK(is_one_line(ended.err));
    const auto report = nlohmann::json::parse(contents(folder.path / "part.json"), nullptr, false);
    CHECK_FALSE(report.is_discarded());
  }

  TEST_CASE("an input without end is exit 2 and one line that tells the limit, within bounded memory") {
    const Folder folder;
    const auto ended = folder.run({"walk", "/dev/zero", "--head", "0"});
    CAPTURE(ended.err);
    CHECK(ended.status == 2);
    CHECK(is_one_line(ended.err));
    CHECK(ended.err.find("/dev/zero: more than 8388608 bytes") != std::string::npos);
    CHECK(ended.peak_bytes < 1024 * mib);
  }

  TEST_CASE("Ctrl-C in a cost report ends it with exit 130 and every file whole, holding what was measured") {
    const Folder folder;
    const auto child = folder.start({"cost", "cyclic", "cyclic", "--axes", "colour", "--rounds", "1000",
                                     "--json", "part.json", "--csv", "part.csv", "--html", "part.html"});
    // Linux tells which signals a process catches: then the measuring has begun.
    const auto catches_interrupt = [child] {
      const auto status = contents("/proc/" + std::to_string(child) + "/status");
      const auto at = status.find("SigCgt:");
      return at != std::string::npos &&
             (std::stoull(status.substr(at + 7), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
    };
    for (int i = 0; i < 6000 && !catches_interrupt(); ++i) usleep(10'000);
    REQUIRE(catches_interrupt());
    sleep(2);
    kill(child, SIGINT);
    const auto ended = folder.end(child);
    CAPTURE(ended.err);
    CHECK(ended.status == 130);
    CHECK(is_one_line(ended.err));
    const auto report = nlohmann::json::parse(contents(folder.path / "part.json"), nullptr, false);
    REQUIRE_FALSE(report.is_discarded());
    REQUIRE(report["scenes"].size() == 1);
    CHECK(report["scenes"][0]["complete"] == false);
    const auto csv = contents(folder.path / "part.csv");
    CHECK(csv.starts_with("scene,axis,"));
    CHECK(csv.ends_with("\r\n"));
    CHECK(contents(folder.path / "part.html").ends_with("</html>\n"));
    CHECK_FALSE(folder.has_leftovers());
  }

  TEST_CASE("a dump that unpacks to more than 1 GiB is exit 2 and one line, within bounded memory") {
    for (const auto compression : {dump::Compression::zstd, dump::Compression::xz}) {
      const Folder folder;
      std::vector<std::byte> packets(64 * mib);  // empty ones behind the first magic
      const auto frame = dump::pack(packets, compression);
      std::ranges::copy(dump::write_dump({}, dump::DumpFormat::standard), packets.begin());
      const auto first = dump::pack(packets, compression);
      std::string bomb(reinterpret_cast<const char*>(first.data()), first.size());
      for (int i = 1; i < 24; ++i) bomb.append(reinterpret_cast<const char*>(frame.data()), frame.size());
      REQUIRE(bomb.size() < mib);
      folder.put("bomb.psxgpu", bomb);
      const auto ended = folder.run({"replay", "bomb.psxgpu"});
      CAPTURE(ended.err);
      CHECK(ended.status == 2);
      CHECK(is_one_line(ended.err));
      CHECK(ended.err.find("unpacks to more than 1073741824 bytes") != std::string::npos);
      CHECK(ended.peak_bytes < 3 * 1024 * mib);  // twice the limit while the vector grows, and the sanitizers
    }
  }

  TEST_CASE("an xz dump that asks for a window of 4 GiB is exit 2 and one line, within bounded memory") {
    const Folder folder;
    const auto frame = dump::pack(std::vector<std::byte>(64), dump::Compression::xz);
    std::string file(reinterpret_cast<const char*>(frame.data()), frame.size());
    // Behind 12 bytes of stream header the block header: its size in words less one, flags, sizes, then
    // filter LZMA2 (21h), 1 byte of properties, which is the dictionary's size; CRC32 at the end.
    const std::size_t header_bytes = 4 * (static_cast<std::size_t>(file[12]) + 1),
                      filter = file.find("\x21\x01", 14);
    REQUIRE(filter < 12 + header_bytes);
    file[filter + 2] = 40;  // 4 GiB - 1
    const auto crc = lzma_crc32(reinterpret_cast<const std::uint8_t*>(file.data()) + 12, header_bytes - 4, 0);
    for (std::size_t i = 0; i < 4; ++i) file[12 + header_bytes - 4 + i] = static_cast<char>(crc >> (8 * i));
    folder.put("window.psxgpu", file);
    const auto ended = folder.run({"replay", "window.psxgpu"});
    CAPTURE(ended.err);
    CHECK(ended.status == 2);
    CHECK(is_one_line(ended.err));
    CHECK(ended.err.find("needs over 256 MiB to unpack") != std::string::npos);
    CHECK(ended.peak_bytes < 512 * mib);
  }

  TEST_CASE("a polyline without an end is exit 2 and one line; one of a million segments is drawn") {
    const Folder folder;
    std::string points;
    for (std::uint32_t i = 0; i < 1'000'000; ++i) {
      const std::uint32_t word = (i % 320) | (i * 7 % 240) << 16;
      for (unsigned shift = 0; shift < 32; shift += 8) points += static_cast<char>(word >> shift);
    }
    const auto dump = [&](const std::string& tail) {
      const auto words = 1 + (points.size() + tail.size()) / 4;
      std::string file("PSXGPUDUMPv1r1\0\0\1\0\0\6\2\0\0\0", 24);
      for (unsigned shift = 0; shift < 24; shift += 8) file += static_cast<char>(words >> shift);
      return file + std::string("\0\xff\xff\xff\x48", 5) + points + tail;
    };
    folder.put("endless.psxgpu", dump(""));
    folder.put("long.psxgpu", dump("UUUU"));
    const auto endless = folder.run({"replay", "endless.psxgpu", "--vram", "x.png"});
    CAPTURE(endless.err);
    CHECK(endless.status == 2);
    CHECK(is_one_line(endless.err));
    CHECK(endless.err.find("polyline that begins here has no end") != std::string::npos);
    CHECK_FALSE(fs::exists(folder.path / "x.png"));
    const auto drawn = folder.run({"replay", "long.psxgpu", "--vram", "x.png"});
    CAPTURE(drawn.err);
    CHECK(drawn.status == 0);
    CHECK(drawn.peak_bytes < 512 * mib);
  }

  TEST_CASE(
      "a frame that fills main RAM is split by bucket; a bucket that does not fit alone is exit 1 and one "
      "line") {
    const Folder folder;
    {
      // 490,000 triangles of 5 words each are 9.8 million bytes.
      constexpr int n = 700;
      std::ofstream file(folder.path / "full.obj", std::ios::binary);
      for (int i = 0; i < n; ++i) {
        const double x = i % 30, y = i / 30;
        file << "v " << x << " " << y << " 0\nv " << x + 1 << " " << y << " 0\nv " << x << " " << y + 1
             << " 0\n";
      }
      for (int k = 0; k < n; ++k) {
        for (int i = 0; i < n; ++i) file << "f " << 3 * i + 1 << " " << 3 * i + 2 << " " << 3 * i + 3 << "\n";
      }
    }
    const auto split = folder.run({"render", "full.obj", "-o", "x.png"});
    CAPTURE(split.err);
    CHECK(split.status == 0);
    CHECK(split.peak_bytes < 1024 * mib);
    const auto refused = folder.run({"render", "full.obj", "-o", "y.png", "--buckets", "1"});
    CAPTURE(refused.err);
    CHECK(refused.status == 1);
    CHECK(is_one_line(refused.err));
    CHECK(refused.err.find("bytes of main RAM") != std::string::npos);
    CHECK_FALSE(fs::exists(folder.path / "y.png"));
  }

  TEST_CASE("a model of ten million faces is exit 2 and one line, within bounded memory") {
    const Folder folder;
    {
      std::ofstream file(folder.path / "huge.obj", std::ios::binary);
      file << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
      std::string lines;
      for (int i = 0; i < 1000; ++i) lines += "f 1 2 3\n";
      for (int i = 0; i < 10'000; ++i) file << lines;
    }
    const auto ended = folder.run({"render", "huge.obj", "-o", "x.png"});
    CAPTURE(ended.err);
    CHECK(ended.status == 2);
    CHECK(is_one_line(ended.err));
    CHECK(ended.err.find("1,000,000 faces") != std::string::npos);
    CHECK(ended.peak_bytes < 1024 * mib);
    CHECK_FALSE(fs::exists(folder.path / "x.png"));
  }

  TEST_CASE("a texture of 16384 x 16384 texels is left out with one line, within bounded memory") {
    const Folder folder;
    // A PNG's first 33 bytes are all that is looked at: signature, IHDR, its CRC (not checked so early).
    folder.put("huge.png",
               std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x40\0\0\0\x40\0\x08\x02\0\0\0", 29) +
                   std::string(64, '\0'));
    folder.put("m.mtl", "newmtl m\nmap_Kd huge.png\n");
    folder.put("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    const auto ended = folder.run({"render", "m.obj", "-o", "x.png"});
    CAPTURE(ended.err);
    CHECK(ended.status == 0);
    CHECK(is_one_line(ended.err));
    CHECK(ended.err.find("16384 x 16384") != std::string::npos);
    CHECK(ended.peak_bytes < 512 * mib);
  }

  TEST_CASE("X3D groups nested a hundred thousand deep are exit 2 and one line") {
    const Folder folder;
    std::string text = "<X3D><Scene>";
    for (int i = 0; i < 100'000; ++i) text += "<Group>";
    for (int i = 0; i < 100'000; ++i) text += "</Group>";
    folder.put("deep.x3d", text + "</Scene></X3D>");
    const auto ended = folder.run({"render", "deep.x3d", "-o", "x.png"});
    CAPTURE(ended.err);
    CHECK(ended.status == 2);
    CHECK(is_one_line(ended.err));
    CHECK(ended.peak_bytes < 512 * mib);
  }

  TEST_CASE("X3D groups that use each other, doubling forty times, are exit 2 and one line") {
    const Folder folder;
    std::string text =
        "<X3D><Scene><Group DEF='g0'><Shape><IndexedFaceSet coordIndex='0 1 2 -1'>"
        "<Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape></Group>";
    for (int i = 1; i < 40; ++i) {
      const auto use = "<Group USE='g" + std::to_string(i - 1) + "'/>";
      text += "<Group DEF='g" + std::to_string(i) + "'>" + use + use + "</Group>";
    }
    folder.put("doubling.x3d", text + "</Scene></X3D>");
    const auto ended = folder.run({"render", "doubling.x3d", "-o", "x.png"});
    CAPTURE(ended.err);
    CHECK(ended.status == 2);
    CHECK(is_one_line(ended.err));
    CHECK(ended.err.find("1,000,000 elements after USE") != std::string::npos);
    CHECK(ended.peak_bytes < 512 * mib);
  }

  TEST_CASE("a canvas of five gigabytes is refused with one line before it is allocated") {
    const Folder folder;
    const auto ended = folder.run({"render", "crates", "-o", "x.png", "--resolution", "8", "--antialias",
                                   "random-64", "--size", "640x480"});
    CAPTURE(ended.err);
    CHECK(ended.status != 0);
    CHECK(is_one_line(ended.err));
    CHECK(ended.err.find("2147483648") != std::string::npos);
    CHECK(ended.peak_bytes < 512 * mib);
    CHECK_FALSE(fs::exists(folder.path / "x.png"));
  }
}
