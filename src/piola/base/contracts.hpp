// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>
#include <string>

namespace piola {

/// Thrown when a contract is violated: a programming error, never an error of the user.
class ContractError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws ContractError. Called by the macros below only.
[[noreturn]] inline void contract_broken(char const* kind, char const* condition, char const* file, int line) {
  throw ContractError(std::string(file) + ":" + std::to_string(line) + ": " + kind + " does not hold: " + condition);
}

}  // namespace piola

/// Preconditions and postconditions of functions. Checked when PIOLA_CONTRACTS is 1 (presets dev and audit); otherwise
/// the condition is not even evaluated. Host code only.
#if defined(PIOLA_CONTRACTS) && PIOLA_CONTRACTS
#define PIOLA_EXPECTS(condition) \
  ((condition) ? void(0) : ::piola::contract_broken("expectation", #condition, __FILE__, __LINE__))
#define PIOLA_ENSURES(condition) \
  ((condition) ? void(0) : ::piola::contract_broken("promise", #condition, __FILE__, __LINE__))
#else
#define PIOLA_EXPECTS(condition) void(sizeof(!(condition)))
#define PIOLA_ENSURES(condition) void(sizeof(!(condition)))
#endif
