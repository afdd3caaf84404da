#pragma once
// What a program sent to the GPU, wherever it comes from: a dump, or the list in a saved RAM image. A dump is
// read piece by piece, so that its first frames can be used while the others come.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dump/dump.h"
#include "dump/dump_file.h"
#include "inspect/lint.h"
#include "ot/main_ram.h"

namespace debug {

/// A node of a list in RAM whose payload begins at word `first` of the recording, or of a dump what hangs on
/// one bucket (dump/bucket_note.h).
struct Node {
  std::uint32_t first = 0;    ///< index into Dump::words
  std::uint32_t address = 0;  ///< of its tag; in a dump 0
  std::uint32_t bucket = 0;   ///< gpu::no_bucket without a table, or before its first entry
};

/// The list of a RAM image as it was saved.
struct RamImage {
  ot::MainRam ram{ot::RamSize::mib2};
  std::uint32_t head = 0;
  std::optional<inspect::TableRange> table;
};

class Recording {
 public:
  /// A dump, by its first bytes; nothing but these is read yet. Error (exit 2): cannot be read.
  static base::Result<Recording> open(const std::filesystem::path& path);
  /// A dump that is in memory already.
  explicit Recording(dump::Dump dump);
  /// The list that `image` holds, one frame, drawn over `vram` (1024 x 512 pixels, or none: black). Without a
  /// drawing area of its own it draws everywhere. Error (exit 2): the list does not end well; the text names
  /// the tags.
  static base::Result<Recording> of_list(RamImage image, std::vector<std::uint16_t> vram = {});

  /// Reads on. False: all there is has been read.
  bool read_some(std::size_t bytes);
  /// Reads all. Error (exit 2): the first frame is not whole; a fault behind a whole frame is no error.
  base::Result<void> read_all();

  /// It grows while read_some() is called: keep no references into it.
  [[nodiscard]] const dump::Dump& dump() const { return file_ ? file_->so_far() : memory_; }
  [[nodiscard]] bool is_read() const { return !file_ || file_->is_over(); }
  [[nodiscard]] double read_progress() const { return file_ ? file_->progress() : 1; }
  /// What is wrong with the rest of the dump: "PATH: byte N: ..."; empty: nothing so far.
  [[nodiscard]] const std::string& fault() const { return file_ ? file_->fault() : no_fault_; }

  /// The state of the GPU before the first packet, as gpu::Gpu::save() has it; empty: a new one.
  [[nodiscard]] const std::vector<std::byte>& start() const { return start_; }
  /// Of a list in RAM: its nodes in list order, and the image. Of a dump nodes are there where it names
  /// buckets, and no image is.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::optional<RamImage>& image() const { return image_; }
  [[nodiscard]] bool has_buckets() const { return buckets() != 0; }
  /// The length of the ordering table, of several the longest so far; 0: none is known.
  [[nodiscard]] std::uint32_t buckets() const {
    return image_ && image_->table ? image_->table->length : noted_buckets_;
  }
  /// The node whose payload has word `index` of Dump::words; nullptr: there are no nodes.
  [[nodiscard]] const Node* node_at(std::uint32_t index) const;

 private:
  Recording() = default;
  void take_notes();

  std::optional<dump::DumpFile> file_;
  dump::Dump memory_;
  std::vector<std::byte> start_;
  std::vector<Node> nodes_;
  std::optional<RamImage> image_;
  std::size_t packets_noted_ = 0;  // packets of the dump that were looked at for notes
  std::uint32_t noted_buckets_ = 0;
  std::string no_fault_;
};

}  // namespace debug
