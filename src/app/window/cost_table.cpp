#include "app/window/cost_table.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace app {
namespace {

// Of several settings that change nothing the one that says most about the knobs is the one they are at:
// "rotated-16 tent" rather than "rotated-16" while the filter is tent.
void mark_current(std::vector<CostLine>& lines, const cost::Axis& axis, const scene::Knobs& now) {
  CostLine* best = nullptr;
  for (auto& line : lines) {
    if (line.axis != &axis || line.knobs != now) continue;
    if (best == nullptr || line.setting->values.size() > best->setting->values.size()) best = &line;
  }
  if (best != nullptr) best->is_current = true;
}

std::vector<CostLine> lines_for(const scene::Knobs& now) {
  std::vector<CostLine> lines;
  for (const auto& axis : cost::axes()) {
    for (const auto& setting : axis.settings) {
      auto& line = lines.emplace_back();
      line.axis = &axis;
      line.setting = &setting;
      line.knobs = cost::with(now, setting);
    }
    mark_current(lines, axis, now);
  }
  return lines;
}

}  // namespace

void RollingMedian::add(double value) {
  if (values_.size() < window) {
    values_.push_back(value);
    return;
  }
  values_[oldest_] = value;
  oldest_ = (oldest_ + 1) % window;
}

std::vector<double> RollingMedian::sorted() const {
  assert(!values_.empty());
  auto sorted = values_;
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

double RollingMedian::median() const {
  const auto in_order = sorted();
  const std::size_t middle = in_order.size() / 2;
  return in_order.size() % 2 != 0 ? in_order[middle] : (in_order[middle - 1] + in_order[middle]) / 2;
}

Spread RollingMedian::spread() const {
  const auto in_order = sorted();
  const std::size_t quarter = in_order.size() / 4;
  return {in_order[quarter], in_order[in_order.size() - 1 - quarter]};
}

void CostTable::follow(const scene::Knobs& now) {
  if (!lines_.empty() && now == current_) return;
  current_ = now;
  current_ms_ = {};
  lines_ = lines_for(now);
  due_.reset();
  last_line_ = lines_.size() - 1;
  since_current_ = between;
}

std::optional<double> CostTable::current_ms() const {
  if (current_ms_.count() == 0) return std::nullopt;
  return current_ms_.median();
}

const RollingMedian& CostTable::times(const CostLine& line) const {
  return line.knobs == current_ ? current_ms_ : line.ms;
}

std::optional<double> CostTable::ms(const CostLine& line) const {
  if (times(line).count() == 0) return std::nullopt;
  return times(line).median();
}

std::optional<Spread> CostTable::spread(const CostLine& line) const {
  if (times(line).count() == 0) return std::nullopt;
  return times(line).spread();
}

int CostTable::against_current(const CostLine& line) const {
  constexpr std::size_t enough = 3;
  if (line.knobs == current_ || line.ms.count() < enough || current_ms_.count() < enough) return 0;
  const auto now = current_ms_.spread();
  const auto other = line.ms.spread();
  if (other.low > now.high) return 1;
  return other.high < now.low ? -1 : 0;
}

bool CostTable::is_settled() const {
  return std::all_of(lines_.begin(), lines_.end(), [this](const auto& line) {
    return !line.error.empty() || times(line).count() >= RollingMedian::window;
  });
}

std::optional<double> CostTable::ratio(const CostLine& line) const {
  const auto one = current_ms();
  const auto other = ms(line);
  if (!one || !other || *one <= 0) return std::nullopt;
  return *other / *one;
}

std::size_t CostTable::all() const {
  return static_cast<std::size_t>(
      std::count_if(lines_.begin(), lines_.end(), [&](const auto& l) { return l.knobs != current_; }));
}

std::size_t CostTable::known() const {
  return static_cast<std::size_t>(std::count_if(lines_.begin(), lines_.end(), [&](const auto& l) {
    return l.knobs != current_ && (l.ms.count() != 0 || !l.error.empty());
  }));
}

const scene::Knobs& CostTable::next() {
  assert(!lines_.empty());  // follow() comes first
  due_.reset();
  if (since_current_ >= between) {
    since_current_ = 0;
    return current_;
  }
  for (std::size_t tried = 0; tried < lines_.size(); ++tried) {
    last_line_ = (last_line_ + 1) % lines_.size();
    const auto& line = lines_[last_line_];
    if (line.knobs == current_ || !line.error.empty()) continue;
    ++since_current_;
    due_ = last_line_;
    return line.knobs;
  }
  return current_;
}

void CostTable::add(double ms) { (due_ ? lines_[*due_].ms : current_ms_).add(ms); }

void CostTable::fail(std::string why) {
  if (due_) lines_[*due_].error = std::move(why);
}

std::string options_of(const cost::Setting& setting) {
  std::string text;
  for (const auto& [knob, value] : setting.values) {
    if (!text.empty()) text += ' ';
    text.append("--").append(knob).append(" ").append(value);
  }
  return text;
}

}  // namespace app
