/// \file restrictions.h
/// What a machine may lack: room on its disk, memory, the right to read. Each holds for this process as long as the
/// object lives.
#pragma once

#include <cstddef>
#include <sys/resource.h>
#include <sys/types.h>

namespace cellcut::test {

/// Files may not grow past so many bytes, as on a full disk; what is tried fails and is no signal.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes);
  ~FileSizeLimit();
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit previous_{};
  void (*previousHandler_)(int);
};

/// Room enough to refuse a file in.
inline constexpr std::size_t kPlentyForRefusal = std::size_t{32} << 20;

/// Address space may not grow by more than so many bytes: larger allocations fail, touched or not. Nothing under
/// sanitizers, whose shadow memory takes terabytes.
class AddressSpaceLimit {
 public:
  explicit AddressSpaceLimit(std::size_t bytesMore);
  ~AddressSpaceLimit();
  AddressSpaceLimit(const AddressSpaceLimit&) = delete;
  AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

 private:
  rlimit previous_{};
};

/// For root, who may read and write anything: a user who may not.
class OrdinaryUser {
 public:
  OrdinaryUser();
  ~OrdinaryUser();
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

 private:
  uid_t previous_;
};

}  // namespace cellcut::test
