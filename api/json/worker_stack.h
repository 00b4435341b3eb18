// The signal stack of model/, for the threads of the service.
#ifndef PLENUM_API_JSON_WORKER_STACK_H_
#define PLENUM_API_JSON_WORKER_STACK_H_

#include "model/simulate/signal_stack.h"

namespace plenum::api {

using model::SignalStack;

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_WORKER_STACK_H_
