// The outside world fails: the disk is full, nobody reads, two write at once, someone presses Ctrl-C, a file
// is a bomb. Old files stay whole, the exit status tells, and memory stays bounded.

#include <doctest/doctest.h>
#include <fcntl.h>
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

#include "gpu/compression.h"

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

}  // namespace

TEST_SUITE("otter") {
  TEST_CASE("a disk that fills up is exit 1 and one line, and the file that was there stays whole") {
    const Folder folder;
    REQUIRE(folder.run({"record", "crates", "-o", "good.psxgpu"}).status == 0);
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

  TEST_CASE("a pipe that nobody reads any more is exit 1 and one line") {
    const Folder folder;
    for (const auto& words : std::vector<std::vector<std::string>>{
             {"list", "--long"}, {"inspect", "crates", "--json", "-"}, {"inspect", "crates"}}) {
      std::array<int, 2> ends{};
      REQUIRE(pipe(ends.data()) == 0);
      close(ends[0]);
      const auto ended = folder.run(words, RLIM_INFINITY, ends[1]);
      close(ends[1]);
      CAPTURE(words[0]);
      CAPTURE(ended.err);
      CHECK(ended.status == 1);
      CHECK(is_one_line(ended.err));
    }
  }

  TEST_CASE("instances that write the same file at once leave one whole file") {
    const Folder folder;
    REQUIRE(folder.run({"render", "crates", "-o", "alone.png"}).status == 0);
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) children.push_back(folder.start({"render", "crates", "-o", "shared.png"}));
    for (const auto child : children) CHECK(folder.end(child).status == 0);
    CHECK(contents(folder.path / "shared.png") == contents(folder.path / "alone.png"));
    CHECK_FALSE(folder.has_leftovers());
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
    const Folder folder;
    const auto frame = gpu::pack(std::vector<std::byte>(64 * mib), gpu::Compression::zstd);
    std::string bomb;
    for (int i = 0; i < 24; ++i) bomb.append(reinterpret_cast<const char*>(frame.data()), frame.size());
    REQUIRE(bomb.size() < mib);
    folder.put("bomb.psxgpu.zst", bomb);
    const auto ended = folder.run({"replay", "bomb.psxgpu.zst"});
    CHECK(ended.status == 2);
    CHECK(is_one_line(ended.err));
    CHECK(ended.err.find("unpacks to more than 1073741824 bytes") != std::string::npos);
    CHECK(ended.peak_bytes < 3 * 1024 * mib);  // twice the limit while the vector grows, and the sanitizers
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
}
