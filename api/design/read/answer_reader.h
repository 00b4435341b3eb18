// An answer, designs/1, read back as what the search gave.
#ifndef PLENUM_API_DESIGN_READ_ANSWER_READER_H_
#define PLENUM_API_DESIGN_READ_ANSWER_READER_H_

#include <vector>

#include "api/design/robustness.h"
#include "api/json/reader.h"
#include "optimizer/front/pareto.h"

namespace plenum::api {

// "status", "designs" and "proof".
optimizer::Answer ReadAnswer(Reader& reader, const optimizer::Problem& problem);

// "front" and "front_proof". The point of each design is that of its totals, and is left at that.
optimizer::Front ReadFront(Reader& reader, const std::vector<optimizer::Amount>& amounts,
                           optimizer::Answer answer);

// "robust", and "robustness" of each of the `answer`'s designs, which must say what `request` asks.
optimizer::RobustAnswer ReadRobustAnswer(Reader& reader, const optimizer::Problem& problem,
                                         const RobustRequest& request, optimizer::Answer answer);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_ANSWER_READER_H_
