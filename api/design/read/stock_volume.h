// Volumes of reservoirs and tanks that the catalogue has.
#ifndef PLENUM_API_DESIGN_READ_STOCK_VOLUME_H_
#define PLENUM_API_DESIGN_READ_STOCK_VOLUME_H_

#include "optimizer/problem/problem.h"

namespace plenum::api {

// Whether the row is a reservoir made to measure.
bool IsMadeToMeasure(const optimizer::Choice& choice);

// The reservoir or tank of a row that the problem has.
const model::Reservoir& StockOf(const optimizer::Problem& problem, const optimizer::Choice& choice);

// The design with the volume of the stock reservoir or tank that it names, which the problem has.
optimizer::Design WithReservoirVolume(optimizer::Design design, const optimizer::Problem& problem);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_STOCK_VOLUME_H_
