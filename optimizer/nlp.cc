#include "optimizer/nlp.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {

bool Differentiate(const Nlp& nlp, const std::vector<double>& x, NlpDerivatives& derivatives) {
  constexpr double kStep = 1e-6;
  const std::size_t n = x.size();
  if (!nlp.evaluate(x, derivatives.values)) return false;
  derivatives.gradient.assign(n, 0.0);
  derivatives.jacobian.assign(nlp.constraints, std::vector<double>(n, 0.0));
  std::vector<double> shifted = x;
  for (std::size_t i = 0; i < n; ++i) {
    const double up = std::min(x[i] + kStep, nlp.high[i]);
    const double down = std::max(x[i] - kStep, nlp.low[i]);
    if (!(up > down)) continue;
    NlpValues above, below;
    shifted[i] = up;
    if (!nlp.evaluate(shifted, above)) return false;
    shifted[i] = down;
    if (!nlp.evaluate(shifted, below)) return false;
    shifted[i] = x[i];
    derivatives.gradient[i] = (above.objective - below.objective) / (up - down);
    for (int c = 0; c < nlp.constraints; ++c)
      derivatives.jacobian[c][i] = (above.constraints[c] - below.constraints[c]) / (up - down);
  }
  return true;
}

}  // namespace plenum::optimizer
