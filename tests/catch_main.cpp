#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_session.hpp>
int main(int argc, char** argv) {
  return Catch::Session().run(argc, argv);
}
#else
// Catch2's handlers of signals allocate memory: a program that is to end hangs in malloc, or takes a failure of an
// allocation in the handler for one of its own and goes on.
#define CATCH_CONFIG_NO_POSIX_SIGNALS
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#endif
