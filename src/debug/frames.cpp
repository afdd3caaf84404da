#include "debug/frames.h"

#include "ot/describe.h"
#include "ot/gp1.h"

namespace debug {
using dump::PacketType;

/// Follows the commands of packets, one after the other; `sink(command)` when the GPU begins to obey one,
/// `grow(end)` when more words of it have come.
class Scanner {
 public:
  explicit Scanner(FrameIndex::Open& open) : open_(open), stream_(open.stream) {}

  template <class Sink, class Grow>
  void packet(const dump::Dump& dump, std::size_t number, Sink&& sink, Grow&& grow) {
    const dump::Packet& packet = dump.packets[number];
    if (packet.type == PacketType::port0) port0(dump, number, sink, grow);
    if (packet.type != PacketType::port1) return;
    const auto payload = dump.payload(packet);
    for (std::uint32_t n = 0; n < packet.count; ++n) {
      if (ot::gp1::aborts_command(payload[n])) stream_.abort();
      sink(Command{
          .is_control = true, .first = packet.first + n, .begin = {number, n}, .end = {number, n + 1}});
    }
  }

 private:
  template <class Sink, class Grow>
  void port0(const dump::Dump& dump, std::size_t number, Sink& sink, Grow& grow) {
    const dump::Packet& packet = dump.packets[number];
    const auto payload = dump.payload(packet);
    for (std::uint32_t n = 0; n < packet.count; ++n) {
      const auto pixels = static_cast<std::uint32_t>(stream_.skip_pixels(packet.count - n));
      n += pixels;
      if (pixels != 0) grow(Place{number, n});
      if (n == packet.count) return;
      if (!stream_.is_open()) {
        open_.begin = {number, n};
        open_.first = packet.first + n;
      }
      const bool is_whole = stream_.take(payload[n]);
      const Place end{number, n + 1};
      if (stream_.command() == ot::gp0::Command::annotation) continue;
      if (begins(is_whole)) {
        sink(Command{.drawing = ot::gp0::is_drawing(stream_.command()) ? 1U : 0U,
                     .first = open_.first,
                     .begin = open_.begin,
                     .end = end});
      } else if (is_long()) {
        grow(end);
      }
    }
  }
  /// Whether the GPU begins to obey with the word just taken.
  [[nodiscard]] bool begins(bool is_whole) const {
    if (stream_.command() == ot::gp0::Command::upload) return stream_.length() == 3;
    if (stream_.command() == ot::gp0::Command::polyline) return stream_.length() == stream_.needed();
    return is_whole;
  }
  /// What the GPU obeys before all its words have come.
  [[nodiscard]] bool is_long() const {
    if (stream_.command() == ot::gp0::Command::upload) return stream_.length() > 3;
    return stream_.command() == ot::gp0::Command::polyline && stream_.length() > stream_.needed();
  }

  FrameIndex::Open& open_;
  ot::CommandStream& stream_;
};

void FrameIndex::extend(const dump::Dump& dump, const dump::Frames& frames, dump::Frames::Rest rest) {
  using Rest = dump::Frames::Rest;
  if (is_all_) return;
  Scanner scanner(now_);
  const auto end_frame = [&](std::size_t end) {
    next_.end_packet = end;
    frames_.push_back(next_);
    next_ = {.first_packet = end, .drawing_before = drawings_};
    if (now_.stream.is_open()) open_.emplace(frames_.size(), now_);
  };
  for (; packets_ < frames.known(); ++packets_) {
    scanner.packet(
        dump, packets_,
        [&](const Command& command) {
          ++next_.commands;
          drawings_ += command.drawing;
        },
        [](Place) {});
    if (frames.ends_with(packets_)) end_frame(packets_ + 1);
  }
  is_all_ = rest != Rest::to_come;
  if (rest != Rest::nothing) return;
  if (!frames_.empty() && frames.count() == frames_.size() && frames.end(frames.count()) == packets_) {
    // What came after the last end draws nothing, and is the last frame's.
    frames_.back().end_packet = packets_;
    frames_.back().commands += next_.commands;
  } else if (next_.commands != 0 || frames_.empty()) {
    end_frame(packets_);
  }
}

std::vector<Command> FrameIndex::commands(const dump::Dump& dump, std::size_t index) const {
  const Frame& frame = frames_[index];
  std::vector<Command> commands;
  commands.reserve(frame.commands);
  const auto open = open_.find(index);
  Open now = open == open_.end() ? Open() : open->second;
  Scanner scanner(now);
  std::uint64_t drawings = frame.drawing_before;
  for (std::size_t n = frame.first_packet; n < frame.end_packet; ++n) {
    scanner.packet(
        dump, n,
        [&](Command command) {
          command.number = static_cast<std::uint32_t>(commands.size() + 1);
          if (command.drawing != 0) command.drawing = ++drawings;
          commands.push_back(command);
        },
        [&](Place end) {
          if (!commands.empty() && !commands.back().is_control) commands.back().end = end;
        });
  }
  return commands;
}

namespace {

/// What there is of a command: words as ot::CommandStream keeps them, and how many there are.
ot::CommandStream gathered(const dump::Dump& dump, const Command& command) {
  ot::CommandStream stream;
  for (std::size_t n = command.begin.packet; n <= command.end.packet && n < dump.packets.size(); ++n) {
    const dump::Packet& packet = dump.packets[n];
    if (packet.type != PacketType::port0) continue;
    const auto payload = dump.payload(packet);
    const std::uint32_t end = n == command.end.packet ? command.end.word : packet.count;
    for (std::uint32_t w = n == command.begin.packet ? command.begin.word : 0; w < end; ++w) {
      if (stream.take(payload[w])) return stream;
      if (stream.command() == ot::gp0::Command::upload && stream.length() == 3) return stream;
    }
  }
  return stream;
}

}  // namespace

std::vector<std::uint32_t> words_of(const dump::Dump& dump, const Command& command) {
  if (command.is_control) return {dump.words[command.first]};
  const auto stream = gathered(dump, command);
  return {stream.words().begin(), stream.words().end()};
}

std::vector<std::uint32_t> all_words_of(const dump::Dump& dump, const Command& command) {
  if (command.is_control) return {dump.words[command.first]};
  std::vector<std::uint32_t> words;
  for (std::size_t n = command.begin.packet; n <= command.end.packet && n < dump.packets.size(); ++n) {
    const dump::Packet& packet = dump.packets[n];
    if (packet.type != PacketType::port0) continue;
    const std::uint32_t from = n == command.begin.packet ? command.begin.word : 0;
    const std::uint32_t end = n == command.end.packet ? command.end.word : packet.count;
    const auto part = dump.payload(packet).subspan(from, end - from);
    words.insert(words.end(), part.begin(), part.end());
  }
  return words;
}

std::string describe(const dump::Dump& dump, const Command& command) {
  if (command.is_control) return ot::describe_control(dump.words[command.first]);
  const auto stream = gathered(dump, command);
  return ot::describe(stream.words(), stream.length());
}

std::uint64_t offset_of(const dump::Dump& dump, const Command& command) {
  const dump::Packet& packet = dump.packets[command.begin.packet];
  return packet.offset == 0 ? 0 : packet.offset + 4 + 4 * std::uint64_t{command.begin.word};
}

}  // namespace debug
