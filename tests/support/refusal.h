/// \file refusal.h
/// What is said against bad input.
#pragma once

#include "renderer/base/error.h"

#include <string>

namespace cellcut::test {

/// The message of the InputError that a call ends with; "was not refused" if it ends with none.
template <typename Call>
std::string refusalOf(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "was not refused";
}

}  // namespace cellcut::test
