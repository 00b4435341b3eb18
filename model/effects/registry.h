// Every effect by spec, and the making of its unit for a run.
#ifndef PLENUM_MODEL_EFFECTS_REGISTRY_H_
#define PLENUM_MODEL_EFFECTS_REGISTRY_H_

#include <memory>
#include <span>

#include "model/effects/effect.h"
#include "model/effects/unit.h"

namespace plenum::model {

// The units of the effects in the order of application, their parameters lifted by `lift`. The
// effects must be valid.
template <class T>
std::vector<std::unique_ptr<EffectUnit<T>>> MakeUnits(std::span<const Effect> effects,
                                                      const Lift& lift);

extern template std::vector<std::unique_ptr<EffectUnit<double>>> MakeUnits(std::span<const Effect>,
                                                                           const Lift&);
extern template std::vector<std::unique_ptr<EffectUnit<Dual>>> MakeUnits(std::span<const Effect>,
                                                                         const Lift&);
extern template std::vector<std::unique_ptr<EffectUnit<WideDual>>> MakeUnits(
    std::span<const Effect>, const Lift&);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_REGISTRY_H_
