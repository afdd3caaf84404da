#include "cost/sweep.h"

#include <algorithm>
#include <chrono>

#include "cost/metrics.h"
#include "cost/text.h"

namespace cost {
namespace {

/// A frame to be drawn; rows that ask for the same knobs share it.
struct Job {
  scene::Knobs knobs;
  std::vector<std::size_t> rows;
  std::vector<Stages> samples;
  std::vector<double> cpu = {}, ratios = {};
  Touched touched = {};
  std::uint64_t held_bytes = 0;
};

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// How long a sweep will still take. Settings differ a thousandfold in time, so that steps alone tell
/// little.
class Forecast {
 public:
  Forecast(std::size_t jobs, int rounds) : jobs_(jobs), rounds_(rounds) {}
  /// A job was drawn and its errors measured: a draw takes `draw`, both `all` seconds.
  void first_round(double draw, double all) {
    ++measured_;
    draw_sum_ += draw;
    all_sum_ += all;
  }
  /// A job was drawn again.
  void later_round(double draw) { drawn_sum_ += draw; }
  [[nodiscard]] double seconds_left() const {
    const double share =
        static_cast<double>(jobs_) / static_cast<double>(std::max<std::size_t>(1, measured_));
    return all_sum_ * (share - 1) + std::max(0.0, draw_sum_ * share * (rounds_ - 1) - drawn_sum_);
  }

 private:
  std::size_t jobs_, measured_ = 0;
  int rounds_;
  double draw_sum_ = 0, all_sum_ = 0, drawn_sum_ = 0;
};

scene::Knobs base_of(Direction direction, const Axis& axis, const scene::Knobs& given) {
  if (direction == Direction::up) return console_knobs(given);
  scene::Knobs knobs = accurate_knobs(given);
  if (axis.without_samples) knobs.antialias = {};
  return knobs;
}

std::vector<Row> plan(const SweepOptions& options) {
  std::vector<Row> rows;
  std::vector<const Axis*> wanted = options.axes;
  if (wanted.empty()) {
    for (const auto& axis : axes()) wanted.push_back(&axis);
  }
  for (const Axis* axis : wanted) {
    for (const auto direction : {Direction::up, Direction::down}) {
      for (std::size_t i = 0; i < axis->settings.size(); ++i) {
        const auto& setting = axis->settings[i];
        if (options.quick && !setting.in_quick) continue;
        Row row;
        row.axis = axis;
        row.direction = direction;
        row.setting = setting.name;
        row.knobs = with(base_of(direction, *axis, options.given), setting);
        row.is_console = i == axis->console;
        rows.push_back(std::move(row));
      }
    }
  }
  if (!options.axes.empty()) return rows;
  for (auto& combination : combinations(options.given, options.quick)) {
    Row row;
    row.direction = Direction::cross;
    row.setting = std::move(combination.name);
    row.knobs = combination.knobs;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Job> jobs_of(const std::vector<Row>& rows) {
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto same = std::ranges::find(jobs, rows[i].knobs, &Job::knobs);
    if (same != jobs.end()) {
      same->rows.push_back(i);
    } else {
      jobs.push_back({rows[i].knobs, {i}, {}});
    }
  }
  return jobs;
}

template <class Get>
double median_of(const std::vector<Stages>& samples, Get get) {
  std::vector<double> values(samples.size());
  std::transform(samples.begin(), samples.end(), values.begin(), get);
  return median(values);
}

void summarise(const Job& job, Row& row) {
  row.stages = {median_of(job.samples, [](const Stages& s) { return s.gte; }),
                median_of(job.samples, [](const Stages& s) { return s.ot; }),
                median_of(job.samples, [](const Stages& s) { return s.walk; }),
                median_of(job.samples, [](const Stages& s) { return s.raster; }),
                median_of(job.samples, [](const Stages& s) { return s.filter; })};
  std::vector<double> totals;
  for (const auto& s : job.samples) totals.push_back(s.total());
  row.ms = median(totals);
  row.spread = spread(totals);
  row.cpu_ms = median(job.cpu);
  row.ratio = job.ratios.empty() ? 0 : median(job.ratios);
  row.touched = job.touched;
  row.held_bytes = job.held_bytes;
}

}  // namespace

const Row* SceneResult::find(const Axis& axis, Direction direction, std::string_view setting) const {
  for (const auto& row : rows) {
    if (row.axis == &axis && row.direction == direction && row.setting == setting) return &row;
  }
  return nullptr;
}

std::string Row::label() const {
  if (axis == nullptr) return setting;
  return joined({axis->name, " ", setting,
                 direction == Direction::up ? ", all else as on the console" : ", all else most accurate"});
}

void mark_front(std::vector<Row>& rows) {
  const auto beats = [](const Row& a, const Row& b, auto&& error) {
    return a.ms <= b.ms && error(a) <= error(b) && (a.ms < b.ms || error(a) < error(b));
  };
  const auto own = [](const Row& row) { return row.error(); };
  const auto distance = [](const Row& row) { return row.errors.of(Measure::colour); };
  for (auto& row : rows) {
    row.is_best = std::ranges::none_of(rows, [&](const Row& other) {
      return other.axis == row.axis && other.direction == row.direction && beats(other, row, own);
    });
    row.on_front = std::ranges::none_of(rows, [&](const Row& other) { return beats(other, row, distance); });
  }
}

std::vector<const Row*> front_of(const std::vector<Row>& rows) {
  std::vector<const Row*> front;
  for (const auto& row : rows) {
    const auto same = [&row](const Row* other) { return other->knobs == row.knobs; };
    if (row.on_front && std::ranges::none_of(front, same)) front.push_back(&row);
  }
  std::ranges::stable_sort(front, {}, [](const Row* row) { return row->ms; });
  return front;
}

namespace {

/// The console's frame, drawn just before another one.
class Neighbour {
 public:
  Neighbour(Subject& subject, const scene::Knobs& given)
      : subject_(subject), console_(console_knobs(given)) {}
  void draw() {
    const auto drawn = subject_.draw(console_);
    cpu_ms_ = drawn ? drawn->cpu_ms : 0;
    if (drawn) walls_.push_back(drawn->stages.total());
  }
  void compare(const Drawn& drawn, Job& job) const {
    job.cpu.push_back(drawn.cpu_ms);
    if (cpu_ms_ > 0) job.ratios.push_back(drawn.cpu_ms / cpu_ms_);
  }
  [[nodiscard]] double noise() const { return walls_.empty() ? 0 : spread(walls_) / median(walls_); }

 private:
  Subject& subject_;
  scene::Knobs console_;
  double cpu_ms_ = 0;
  std::vector<double> walls_;
};

}  // namespace

base::Result<SceneResult> sweep(Subject& subject, const SweepOptions& options) {
  SceneResult result;
  result.scene = subject.name();
  result.frame = subject.frame();
  result.width = options.given.width;
  result.height = options.given.height;
  auto rows = plan(options);
  auto jobs = jobs_of(rows);
  const std::size_t steps = jobs.size() * static_cast<std::size_t>(options.rounds);
  std::size_t done = 0;
  Forecast forecast(jobs.size(), options.rounds);
  const auto stopped = [&] { return options.stop && options.stop(); };
  const auto step = [&] {
    if (options.progress) options.progress(++done, steps, forecast.seconds_left());
  };

  ErrorMeter meter(subject, options.given);
  if (auto ready = meter.prepare(); !ready) return tl::make_unexpected(ready.error());
  result.reference = meter.reference();

  Neighbour neighbour(subject, options.given);
  // Errors in the first round: they do not change from round to round.
  for (auto& job : jobs) {
    if (stopped()) break;
    const double start = now_seconds();
    neighbour.draw();
    const auto drawn = subject.draw(job.knobs);
    const double seconds = now_seconds() - start;
    const auto counted = drawn ? touched(subject, job.knobs, *drawn) : tl::make_unexpected(drawn.error());
    const auto errors = counted ? meter.measure(job.knobs) : tl::make_unexpected(counted.error());
    forecast.first_round(seconds, now_seconds() - start);
    step();
    if (!errors) {
      const Row& first = rows[job.rows.front()];
      result.skipped.push_back(std::string(first.axis_name()) + " " + first.setting + ": " +
                               errors.error().text);
      continue;
    }
    job.held_bytes = drawn->held_bytes;
    job.touched = *counted;
    neighbour.compare(*drawn, job);
    job.samples.push_back(drawn->stages);  // the first round: what a stopped sweep can report
    const auto picture = shrunk(subject.picture(), job.knobs.resolution);
    for (const auto r : job.rows) {
      rows[r].errors = *errors;
      rows[r].picture = picture;
      rows[r].difference = heat_map(picture, result.reference);
    }
  }
  std::erase_if(jobs, [&](const Job& job) { return rows[job.rows.front()].picture.width == 0; });

  for (int round = 1; round < options.rounds && !stopped(); ++round) {
    for (auto& job : jobs) {
      if (stopped()) break;
      const double start = now_seconds();
      neighbour.draw();
      if (const auto drawn = subject.draw(job.knobs)) {
        job.samples.push_back(drawn->stages);
        neighbour.compare(*drawn, job);
      }
      forecast.later_round(now_seconds() - start);
      step();
    }
  }
  result.complete = !stopped();
  result.rounds = options.rounds;
  for (const auto& job : jobs) result.rounds = std::min(result.rounds, static_cast<int>(job.samples.size()));
  for (const auto& job : jobs) {
    for (const auto r : job.rows) {
      if (!job.samples.empty()) summarise(job, rows[r]);
    }
  }
  std::erase_if(rows, [](const Row& row) { return row.picture.width == 0 || row.ms <= 0; });
  mark_front(rows);
  result.noise = neighbour.noise();
  result.rows = std::move(rows);
  return result;
}

}  // namespace cost
