// Plots of a diagnosis (diagnosis/1) as figures of an HTML report.
#ifndef PLENUM_SERVER_RENDER_RESIDUAL_PLOTS_H_
#define PLENUM_SERVER_RENDER_RESIDUAL_PLOTS_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

// One run of `series`: measured and modelled pressure, and the residual before and after over its
// phases, with a band of two standard deviations of the noise (none where that is not a number).
std::string RunPlots(const api::Json& series, double noise_kpa);

// RMS of the residual over all samples of each phase, before and after; runs held out too.
std::string PhasePlot(const api::Json& answer, double noise_kpa);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_RESIDUAL_PLOTS_H_
