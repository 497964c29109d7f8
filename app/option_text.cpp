#include "app/option_text.h"

#include <CLI/CLI.hpp>

namespace cellcut {

CLI::Option* addText(CLI::App& verb, const std::string& name, const std::string& type,
                     const std::function<void(const std::string&)>& use, const std::string& description) {
  return verb.add_option_function<std::string>(name, use, description)->type_name(type);
}

}  // namespace cellcut
