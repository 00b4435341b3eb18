#include "optimizer/explain/robust_draws.h"

#include <algorithm>
#include <cmath>

#include "optimizer/sizing/resize.h"

namespace plenum::optimizer {

Combination CombinationOf(const Design& design) { return {IdsOf(design), design.configuration}; }

Draws::Draws(const Problem& problem, const SearchOptions& search_options,
             const RobustOptions& options, const DrawParts& draw_parts)
    : problem_(problem),
      search_options_(search_options),
      options_(options),
      draw_parts_(draw_parts) {
  problem_.parts = {};
}

int Draws::Run(const std::vector<Design>& designs) {
  start_ = std::chrono::steady_clock::now();
  std::vector<Objectives*> drawn;
  drawn.reserve(designs.size());
  for (const Design& design : designs) drawn.push_back(&objectives_[KeyOf(design)]);
  int draw = 0;
  for (bool whole = true; draw < options_.draws && whole; draw += whole)
    for (std::size_t i = 0; i < designs.size() && whole; ++i) {
      if (drawn[i]->size() > static_cast<std::size_t>(draw) || Hopeless(*drawn[i])) continue;
      const double objective = ObjectiveIn(designs[i], draw);
      whole = !stopped();
      if (whole) drawn[i]->push_back(objective);
    }
  used_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  start_ = {};
  return draw;
}

bool Draws::stopped() const {
  double used_s = used_s_;
  if (start_ != decltype(start_){})
    used_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return used_s > options_.time_limit_s ||
         (search_options_.cancelled && search_options_.cancelled());
}

int Draws::Met(const Design& design, int draws) const {
  const Objectives& drawn = of(design);
  const auto end = drawn.begin() + std::min<std::ptrdiff_t>(draws, std::ssize(drawn));
  return static_cast<int>(
      std::count_if(drawn.begin(), end, [](double value) { return std::isfinite(value); }));
}

bool Draws::Reaches(const Design& design, int draws) const {
  return draws > 0 && Met(design, draws) >= options_.probability_min.value_or(0.0) * draws;
}

bool Draws::Hopeless(const Objectives& drawn) const {
  if (!options_.probability_min) return false;
  const auto missed = std::count_if(drawn.begin(), drawn.end(),
                                    [](double objective) { return std::isinf(objective); });
  return options_.draws - static_cast<int>(missed) < *options_.probability_min * options_.draws;
}

double Draws::ObjectiveIn(const Design& design, int draw) {
  problem_.parts = draw_parts_(design, draw);
  const Leaf leaf = Resize(problem_, design, [this] { return stopped(); });
  return leaf.status == LeafStatus::kFeasible ? leaf.objective : kUnlimited;
}

}  // namespace plenum::optimizer
