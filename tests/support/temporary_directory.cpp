#include "tests/support/temporary_directory.h"

#include <iterator>
#include <stdexcept>
#include <stdlib.h>
#include <string>

namespace cellcut::test {

namespace fs = std::filesystem;

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (fs::temp_directory_path() / "cellcut-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a folder like " + name);
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::permissions(path_, fs::perms::owner_all, ignored);  // a test may have taken them away
  fs::remove_all(path_, ignored);
}

std::size_t TemporaryDirectory::fileCount() const {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
}

}  // namespace cellcut::test
