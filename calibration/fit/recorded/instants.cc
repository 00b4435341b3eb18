#include "calibration/fit/recorded/instants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "calibration/values/crossing.h"

namespace plenum::calibration {
namespace {

using model::ValveState;

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr double kOfTwo = 1.0 / std::numbers::sqrt2;  // of two errors that are independent
constexpr std::size_t kReadingsMax = 20'000;          // that a guess looks at
constexpr std::size_t kLeastWindow = 3, kMostWindow = 15, kWindowsPerCommand = 10;

ValveState Before(const Run& run, std::size_t command) {
  return command > 0 ? run.valve[command - 1].state : ValveState::kHold;
}

bool Turns(const Run& run, std::size_t command) {
  return run.valve[command].state != Before(run, command);
}

double IntervalOf(const Run& run) {
  return (run.t_s.back() - run.t_s.front()) / static_cast<double>(run.t_s.size() - 1);
}

// Which way a command bends the curve.
double BendOf(const Run& run, std::size_t command) {
  const auto level = [&](ValveState state) {
    if (state == ValveState::kHold) return 0.0;
    return (state == ValveState::kInflate) != Evacuates(run) ? 1.0 : -1.0;
  };
  const double change = level(run.valve[command].state) - level(Before(run, command));
  return change > 0.0 ? 1.0 : change < 0.0 ? -1.0 : 0.0;
}

struct Curve {
  std::vector<double> t_s, y;
};

double SlopeOver(const Curve& curve, std::size_t first, std::size_t last) {
  const double count = static_cast<double>(last - first + 1);
  double t_mean = 0.0, y_mean = 0.0;
  for (std::size_t i = first; i <= last; ++i)
    t_mean += curve.t_s[i] / count, y_mean += curve.y[i] / count;
  double tt = 0.0, ty = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    tt += (curve.t_s[i] - t_mean) * (curve.t_s[i] - t_mean);
    ty += (curve.t_s[i] - t_mean) * (curve.y[i] - y_mean);
  }
  return tt > 0.0 ? ty / tt : 0.0;
}

// By how much the curve's slope grows at each reading; 0 at the ends, where one side is missing.
std::vector<double> BendsOf(const Curve& curve, std::size_t window) {
  std::vector<double> bends(curve.t_s.size(), 0.0);
  for (std::size_t i = 1; i + 1 < bends.size(); ++i) {
    const std::size_t first = i < window ? 0 : i - window;
    const std::size_t last = std::min(bends.size() - 1, i + window);
    bends[i] = SlopeOver(curve, i, last) - SlopeOver(curve, first, i);
  }
  return bends;
}

struct Bends {
  std::vector<double> size;
  std::size_t width = 1;  // of a single one, in readings: two commands are no nearer, if they can
};

// Commands `first` to `last`, which are not known, at readings `from` to `to`.
void GuessBetween(const Curve& curve, const Bends& bends, std::size_t from, std::size_t to,
                  std::size_t first, std::size_t last, Run& run) {
  const std::size_t readings = to - from, commands = last - first;
  if (readings < commands) return;
  const std::size_t apart = std::clamp<std::size_t>(readings / (commands + 1), 1, 2 * bends.width);
  // best[k][i]: of the first k + 1 commands with the last of them at reading from + i or before.
  std::vector<std::vector<double>> best(commands, std::vector<double>(readings, kNever));
  std::vector<std::vector<std::size_t>> at(commands, std::vector<std::size_t>(readings, 0));
  for (std::size_t k = 0; k < commands; ++k) {
    const double sign = BendOf(run, first + k);
    for (std::size_t i = k * apart; i < readings; ++i) {
      const double before = k == 0 ? 0.0 : best[k - 1][i - apart];
      const double here = before + sign * bends.size[from + i];
      const bool later = i > k * apart && best[k][i - 1] >= here;
      best[k][i] = later ? best[k][i - 1] : here;
      at[k][i] = later ? at[k][i - 1] : i;
    }
  }
  std::size_t i = readings - 1;
  for (std::size_t k = commands; k-- > 0;) {
    const std::size_t found = at[k][i];
    run.valve[first + k].time_s = curve.t_s[from + found];
    i = found >= apart ? found - apart : 0;
  }
}

Curve FiniteReadings(const Run& run) {
  Curve curve;
  const std::size_t stride = 1 + run.t_s.size() / kReadingsMax;
  for (std::size_t i = 0; i < run.t_s.size(); i += stride) {
    if (std::isnan(run.pressure_pa[i])) continue;
    curve.t_s.push_back(run.t_s[i]);
    curve.y.push_back(run.pressure_pa[i]);
  }
  return curve;
}

// From a command to its neighbour: half of it where the neighbour may move, too.
double RoomTo(const Run& run, std::size_t command, std::size_t neighbour) {
  const double room_s = std::abs(run.valve[neighbour].time_s - run.valve[command].time_s);
  return InstantUncertainty(run, neighbour) > 0.0 ? 0.5 * room_s : room_s;
}

// How far a command may be moved, in units of `scale`: half as far where it has two errors.
struct Room {
  double low = 0.0, high = 0.0;
};

Room RoomOf(const Run& run, std::size_t k, double scale) {
  const double time_s = run.valve[k].time_s;
  const double before_s = k > 0 ? RoomTo(run, k, k - 1) : time_s - StartOf(run);
  const double after_s = k + 1 < run.valve.size() ? RoomTo(run, k, k + 1) : run.t_s.back() - time_s;
  const double share = SharesInstant(run, k) ? 0.5 : 1.0;
  const double most_s = kInstantSigmas * InstantUncertainty(run, k);
  return {-std::min(most_s, share * before_s) / scale, std::min(most_s, share * after_s) / scale};
}

bool Shares(const Run& run, std::size_t command) {
  return SharesInstant(run, command) && Turns(run, command);
}

bool HasOwnInstants(const Run& run) {
  std::size_t shared = 0;
  for (std::size_t k = 0; k < run.valve.size(); ++k) shared += Shares(run, k);
  return shared * run.t_s.size() <= kOwnInstantsMax;
}

// What of the uncertainty of commands to a state is their own and what they share.
struct Parts {
  double own = 1.0, shared = 0.0;
};

// By state, of all runs of the data set.
std::array<Parts, model::kValveStates> PartsOf(const Dataset& dataset) {
  std::array<std::size_t, model::kValveStates> commands{};
  std::array<bool, model::kValveStates> own{};
  for (const Run& run : dataset.runs) {
    const bool has_own = HasOwnInstants(run);
    for (std::size_t k = 0; k < run.valve.size(); ++k) {
      if (!Shares(run, k)) continue;
      const auto state = static_cast<std::size_t>(run.valve[k].state);
      ++commands[state];
      own[state] |= has_own;
    }
  }
  std::array<Parts, model::kValveStates> parts{};
  for (std::size_t state = 0; state < parts.size(); ++state)
    if (commands[state] > 1) parts[state] = own[state] ? Parts{kOfTwo, kOfTwo} : Parts{0.0, 1.0};
  return parts;
}

}  // namespace

std::vector<Coordinate> InstantCoordinates(const Dataset& dataset,
                                           const std::vector<std::size_t>& runs) {
  const auto parts = PartsOf(dataset);
  std::vector<Coordinate> coordinates;
  for (const std::size_t i : runs) {
    const Run& run = dataset.runs[i];
    const bool own = HasOwnInstants(run);
    for (std::size_t k = 0; k < run.valve.size(); ++k) {
      const double uncertainty_s = InstantUncertainty(run, k);
      const bool shares = SharesInstant(run, k);
      if (!(uncertainty_s > 0.0) || !Turns(run, k) || (!own && shares)) continue;
      const auto state = static_cast<std::size_t>(run.valve[k].state);
      Coordinate coordinate;
      coordinate.parameter = {.kind = Parameter::Kind::kInstant, .number = k, .run = i};
      coordinate.prior = shares;
      coordinate.scale = shares ? uncertainty_s * parts[state].own : IntervalOf(run);
      const Room room = RoomOf(run, k, coordinate.scale);
      coordinate.low = room.low;
      coordinate.high = room.high;
      if (coordinate.high > coordinate.low) coordinates.push_back(coordinate);
    }
  }
  return coordinates;
}

std::vector<Coordinate> SharedInstantCoordinates(const Dataset& dataset,
                                                 const std::vector<std::size_t>& runs) {
  const auto parts = PartsOf(dataset);
  std::array<Room, model::kValveStates> least;
  least.fill({-kUnknown, kUnknown});
  for (const std::size_t i : runs) {
    const Run& run = dataset.runs[i];
    for (std::size_t k = 0; k < run.valve.size(); ++k) {
      const auto state = static_cast<std::size_t>(run.valve[k].state);
      if (!Shares(run, k) || parts[state].shared == 0.0) continue;
      const Room room = RoomOf(run, k, parts[state].shared * InstantUncertainty(run, k));
      least[state] = {std::max(least[state].low, room.low), std::min(least[state].high, room.high)};
    }
  }
  std::vector<Coordinate> coordinates;
  for (std::size_t state = 0; state < least.size(); ++state) {
    Coordinate coordinate;
    coordinate.parameter = {.kind = Parameter::Kind::kSharedInstant, .number = state};
    coordinate.prior = true;
    coordinate.scale = parts[state].shared;
    coordinate.low = least[state].low;
    coordinate.high = least[state].high;
    if (coordinate.scale > 0.0 && std::isfinite(coordinate.high) &&
        coordinate.high > coordinate.low)
      coordinates.push_back(coordinate);
  }
  return coordinates;
}

bool NoInstantIsExact(const Run& run) {
  if (!HasOwnInstants(run)) return false;
  for (std::size_t k = 0; k < run.valve.size(); ++k)
    if (Turns(run, k) && !(InstantUncertainty(run, k) > 0.0)) return false;
  return true;
}

void GuessInstants(Run& run) {
  const Curve curve = FiniteReadings(run);
  if (curve.t_s.size() < 2) return;
  const std::size_t window = std::clamp(
      curve.t_s.size() / (kWindowsPerCommand * (run.valve.size() + 1)), kLeastWindow, kMostWindow);
  const Bends bends{BendsOf(curve, window), window};
  const auto reading_after = [&](double t_s) {
    return static_cast<std::size_t>(std::upper_bound(curve.t_s.begin(), curve.t_s.end(), t_s) -
                                    curve.t_s.begin());
  };
  for (std::size_t first = 0; first < run.valve.size(); ++first) {
    if (!std::isnan(run.valve[first].time_s)) continue;
    std::size_t last = first;
    while (last < run.valve.size() && std::isnan(run.valve[last].time_s)) ++last;
    const std::size_t from = first > 0 ? reading_after(run.valve[first - 1].time_s) : 0;
    const std::size_t to =
        last < run.valve.size() ? reading_after(run.valve[last].time_s) : curve.t_s.size();
    if (to > from) GuessBetween(curve, bends, from, to, first, last, run);
    first = last;
  }
}

}  // namespace plenum::calibration
