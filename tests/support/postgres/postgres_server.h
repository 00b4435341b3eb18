// A server of PostgreSQL of the test program's own, in a temporary folder, reached by a Unix
// socket. It ends with the program.
#ifndef PLENUM_TESTS_SUPPORT_POSTGRES_POSTGRES_SERVER_H_
#define PLENUM_TESTS_SUPPORT_POSTGRES_POSTGRES_SERVER_H_

#include <functional>
#include <string>

namespace plenum::test {

// Why there is no server; empty where there is one, and then nothing is skipped.
std::string WhyNoPostgres();

// The address of a new, empty database; the server starts with the first one. Its own order of text
// is that of American English, so that what relies on it is found.
std::string NewDatabase();

// The server dies as if the power went, and starts again.
void CrashPostgres();

// Runs something while there is no server.
void WhilePostgresIsAway(const std::function<void()>& run);

// Ends the sessions of all clients of the server, which goes on.
void CutSessions();

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_POSTGRES_POSTGRES_SERVER_H_
