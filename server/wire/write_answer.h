// Answers as HTTP/1.1 (RFC 9112).
#ifndef PLENUM_SERVER_WIRE_WRITE_ANSWER_H_
#define PLENUM_SERVER_WIRE_WRITE_ANSWER_H_

#include "server/call/reply.h"
#include "server/wire/exchange.h"

namespace plenum::server {

struct AnswerForm {
  bool is_head = false;   // HEAD: no body
  bool may_chunk = true;  // not HTTP/1.0, where the end of the connection ends the body
  bool closes = false;    // the connection ends after it
};

// Gives the answer to `out`: head and body, or the head and what makes the body.
void WriteAnswer(Reply reply, const AnswerForm& form, Outgoing& out);

// The whole of an answer that is not made piece by piece, after which the connection ends.
std::string AnswerText(const Reply& reply);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_WRITE_ANSWER_H_
