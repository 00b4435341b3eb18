// Bonmin on binaries of choices whose flow elements and bore are sums over them, in nine continuous
// variables; rise and fall time are smooth functions of these.
#include <sys/wait.h>
#include <unistd.h>

#include <BonBonminSetup.hpp>
#include <BonCbc.hpp>
#include <BonTMINLP.hpp>
#include <chrono>
#include <cmath>
#include <sstream>

#include "bench/search/base_rows.h"
#include "bench/search/rival.h"

namespace plenum::bench {
namespace {

using Bonmin::TMINLP;
using Ipopt::Index;
using Ipopt::Number;
using Ipopt::TNLP;
using Clock = ProcessorClock;

constexpr double kConductance = 1e-8;  // of 1 dm³/(s·bar)
constexpr int kAttributes = 9;  // C and b of valve in, valve out, fitting, regulator; bore in mm
constexpr double kStep = 1e-6;  // of central differences, relative

BaseAttributes Unpack(const Number* a) {
  const auto element = [&](int i) { return model::FlowElement{a[i] * kConductance, a[i + 1]}; };
  return {element(0), element(2), element(4), element(6), a[8] * 1e-3};
}

std::array<double, kAttributes> Pack(const BaseAttributes& a) {
  const auto c = [](const model::FlowElement& e) {
    return e.sonic_conductance_m3_per_s_pa / kConductance;
  };
  return {c(a.fill),     a.fill.critical_ratio,    c(a.exhaust),   a.exhaust.critical_ratio,
          c(a.fitting),  a.fitting.critical_ratio, c(a.regulator), a.regulator.critical_ratio,
          a.bore_m * 1e3};
}

constexpr std::array<int, kAttributes> kFamilyOf{
    kValves, kValves, kValves, kValves, kFittings, kFittings, kRegulators, kRegulators, kTubes};

class BaseMinlp : public TMINLP {
 public:
  BaseMinlp(const BaseInstance& base, Clock::time_point start)
      : base_(base), start_(start), rows_(LinearRows(base)), choices_(kBaseFamilies * base.size) {
    for (int a = 0; a < kAttributes; ++a) {
      Row row;
      for (int i = 0; i < base.size; ++i) {
        Selection s{};
        s[kFamilyOf[a]] = i;
        const double value = Pack(base.AttributesOf(s))[a];
        low_[a] = i == 0 ? value : std::min(low_[a], value);
        high_[a] = i == 0 ? value : std::max(high_[a], value);
        row.columns.push_back(ColumnOf(base, kFamilyOf[a], i));
        row.values.push_back(value);
      }
      row.columns.push_back(choices_ + a);
      row.values.push_back(-1.0);
      rows_.push_back(std::move(row));
    }
  }

  Outcome outcome;

  bool get_nlp_info(Index& n, Index& m, Index& nonzeros, Index& hessian,
                    TNLP::IndexStyleEnum& style) override {
    n = choices_ + kAttributes;
    m = static_cast<Index>(rows_.size()) + 2;
    nonzeros = 2 * kAttributes;
    for (const Row& row : rows_) nonzeros += static_cast<Index>(row.columns.size());
    hessian = 0;
    style = TNLP::C_STYLE;
    return true;
  }

  bool get_variables_types(Index n, VariableType* types) override {
    for (Index i = 0; i < n; ++i) types[i] = i < choices_ ? BINARY : CONTINUOUS;
    return true;
  }

  bool get_variables_linearity(Index n, TNLP::LinearityType* types) override {
    for (Index i = 0; i < n; ++i) types[i] = i < choices_ ? TNLP::LINEAR : TNLP::NON_LINEAR;
    return true;
  }

  bool get_constraints_linearity(Index m, TNLP::LinearityType* types) override {
    for (Index i = 0; i < m; ++i) types[i] = i < m - 2 ? TNLP::LINEAR : TNLP::NON_LINEAR;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_low, Number* x_high, Index m, Number* g_low,
                       Number* g_high) override {
    for (Index i = 0; i < n; ++i) {
      const bool choice = i < choices_;
      x_low[i] = choice ? 0.0 : low_[i - choices_];
      x_high[i] = choice ? base_.stands[i / base_.size][i % base_.size] : high_[i - choices_];
    }
    for (Index i = 0; i < m; ++i) {
      g_low[i] = i < m - 2 ? std::max(rows_[i].low, -1e19) : -1e19;
      g_high[i] = i < m - 2 ? std::min(rows_[i].high, 1e19) : 1.0;
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    for (int i = 0; i < choices_; ++i) x[i] = 1.0 / base_.size;
    for (int a = 0; a < kAttributes; ++a) x[choices_ + a] = 0.5 * (low_[a] + high_[a]);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = 0.0;
    for (int i = 0; i < choices_; ++i) value += Mass(i) * x[i];
    return true;
  }

  bool eval_grad_f(Index n, const Number*, bool, Number* gradient) override {
    for (Index i = 0; i < n; ++i) gradient[i] = i < choices_ ? Mass(i) : 0.0;
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index m, Number* g) override {
    for (Index r = 0; r < m - 2; ++r) {
      g[r] = 0.0;
      for (std::size_t k = 0; k < rows_[r].columns.size(); ++k)
        g[r] += rows_[r].values[k] * x[rows_[r].columns[k]];
    }
    const BaseAttributes attributes = Unpack(x + choices_);
    g[m - 2] = base_.Rise(attributes);
    g[m - 1] = base_.Fall(attributes);
    return std::isfinite(g[m - 2]) && std::isfinite(g[m - 1]);
  }

  bool eval_jac_g(Index, const Number* x, bool, Index m, Index, Index* row, Index* column,
                  Number* values) override {
    Index at = 0;
    for (Index r = 0; r < m - 2; ++r)
      for (std::size_t k = 0; k < rows_[r].columns.size(); ++k, ++at) {
        if (values) {
          values[at] = rows_[r].values[k];
        } else {
          row[at] = r;
          column[at] = rows_[r].columns[k];
        }
      }
    for (int a = 0; a < kAttributes; ++a) {
      std::array<Number, 2> slopes{};
      if (values) {
        std::array<Number, kAttributes> low, high;
        std::copy_n(x + choices_, kAttributes, low.begin());
        high = low;
        const double step = kStep * std::max(std::abs(low[a]), 0.1);
        low[a] -= step;
        high[a] += step;
        const BaseAttributes below = Unpack(low.data()), above = Unpack(high.data());
        slopes = {(base_.Rise(above) - base_.Rise(below)) / (2.0 * step),
                  (base_.Fall(above) - base_.Fall(below)) / (2.0 * step)};
      }
      for (int k = 0; k < 2; ++k, ++at) {
        if (values) {
          values[at] = slopes[k];
        } else {
          row[at] = m - 2 + k;
          column[at] = choices_ + a;
        }
      }
    }
    return true;
  }

  bool eval_h(Index, const Number*, bool, Number, Index, const Number*, bool, Index, Index*, Index*,
              Number*) override {
    return false;  // Ipopt approximates it
  }

  bool eval_gi(Index n, const Number* x, bool fresh, Index i, Number& value) override {
    std::vector<Number> all(rows_.size() + 2);
    if (!eval_g(n, x, fresh, static_cast<Index>(all.size()), all.data())) return false;
    value = all[i];
    return true;
  }

  void finalize_solution(SolverReturn status, Index, const Number* x, Number) override {
    outcome.claimed = status == SUCCESS;
    outcome.note = status == SUCCESS          ? ""
                   : status == INFEASIBLE     ? "says infeasible"
                   : status == LIMIT_EXCEEDED ? "out of time"
                                              : "gave up";
    if (!x) return;
    outcome.found = true;
    outcome.best = SelectionOf(base_, x);
    outcome.find_s = std::chrono::duration<double>(Clock::now() - start_).count();
  }

  const BranchingInfo* branchingInfo() const override { return nullptr; }
  const SosInfo* sosConstraints() const override { return nullptr; }

 private:
  double Mass(int column) const { return base_.mass_kg[column / base_.size][column % base_.size]; }

  const BaseInstance& base_;
  Clock::time_point start_;
  std::vector<Row> rows_;
  int choices_;
  std::array<double, kAttributes> low_{}, high_{};
};

Outcome Solve(const BaseInstance& base, const std::string& algorithm, double time_limit_s) {
  const Clock::time_point start = Clock::now();
  Ipopt::SmartPtr<BaseMinlp> minlp = new BaseMinlp(base, start);
  Bonmin::BonminSetup setup;
  setup.initializeOptionsAndJournalist();
  std::ostringstream options;
  options << "bonmin.algorithm " << algorithm << "\nbonmin.time_limit " << time_limit_s
          << "\nbonmin.bb_log_level 0\nbonmin.lp_log_level 0\nbonmin.nlp_log_level 0\n"
          << "bonmin.oa_log_level 0\nbonmin.milp_log_level 0\nbonmin.fp_log_level 0\n"
          << "bonmin.allowable_gap 0\nbonmin.allowable_fraction_gap 0\n"
          << "hessian_approximation limited-memory\nprint_level 0\nsb yes\n";
  setup.readOptionsString(options.str());
  setup.initialize(GetRawPtr(minlp));
  Bonmin::Bab search;
  search(setup);
  return minlp->outcome;
}

// What passes the pipe.
struct Message {
  bool found, claimed;
  Selection best;
  double find_s;
  char note[64];
};

// In a process of its own: some runs abort, and some do not heed their time limit.
Outcome SolveApart(const BaseInstance& base, const std::string& algorithm, double time_limit_s) {
  const Clock::time_point start = Clock::now();
  int ends[2];
  Outcome outcome;
  outcome.note = "aborted, or past its time limit";
  if (pipe(ends) != 0) return outcome;
  const pid_t child = fork();
  if (child == 0) {
    alarm(static_cast<unsigned>(std::ceil(1.5 * time_limit_s)));
    const Outcome own = Solve(base, algorithm, time_limit_s);
    Message message{own.found, own.claimed, own.best, own.find_s, {}};
    own.note.copy(message.note, sizeof message.note - 1);
    const bool sent = write(ends[1], &message, sizeof message) == sizeof message;
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  Message message;
  if (read(ends[0], &message, sizeof message) == sizeof message)
    outcome = {message.found, message.claimed, message.best, message.find_s, 0.0, message.note};
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  outcome.total_s = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}

}  // namespace

Rival Bonmin(const std::string& algorithm) {
  const auto solve = [algorithm](const BaseInstance& base, std::uint64_t, double time_limit_s) {
    return SolveApart(base, algorithm, time_limit_s);
  };
  return {"Bonmin " + algorithm,
          "binaries of choices; C and b of each element and the bore as sums over them; exact rise "
          "and fall of these, derivatives by central differences",
          "both gaps 0, limited-memory Hessian, else as it comes", solve};
}

}  // namespace plenum::bench
