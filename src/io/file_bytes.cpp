#include "file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

/// Closes a file when it goes out of scope, unless close() was called.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() {
    if (number_ >= 0) ::close(number_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  bool close() {
    const int result = ::close(number_);
    number_ = -1;
    return result == 0;
  }

 private:
  int number_;
};

[[noreturn]] void throw_input_error(const std::string& path, const char* reason) {
  throw InputError(fmt::format("Cannot read '{}': {}.", path, reason));
}

[[noreturn]] void throw_output_error(const std::string& path, const char* reason) {
  throw OutputError(fmt::format(
      "Cannot write '{}': {}. Check that its folder is there and writable and the disk not full.", path, reason));
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Renaming onto a device would replace the device by a file.
void check_replaceable(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    throw_output_error(path, S_ISDIR(status.st_mode) ? std::strerror(EISDIR) : "it is not a regular file");
  }
}

}  // namespace

std::string read_file(const std::string& path) {
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) throw_input_error(path, std::strerror(errno));
  struct stat status = {};
  if (::fstat(file.number(), &status) != 0) throw_input_error(path, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw_input_error(path, std::strerror(EISDIR));

  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(status.st_size) + 1);
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  while (true) {
    const std::size_t size = bytes.size();
    bytes.resize(size + kBlock);
    const ssize_t count = ::read(file.number(), bytes.data() + size, kBlock);
    bytes.resize(size + (count > 0 ? static_cast<std::size_t>(count) : 0));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw_input_error(path, std::strerror(errno));
    if (count == 0) return bytes;
  }
}

void write_file_whole(const std::string& path, std::string_view bytes) {
  check_replaceable(path);
  const std::string temporary = path + ".part";
  FileDescriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!file.is_open()) throw_output_error(path, std::strerror(errno));
  const bool written = write_all(file.number(), bytes);
  const int write_error = errno;
  // Some file systems report a full disk only when the file is closed.
  const bool closed = file.close();
  const int close_error = errno;
  if (written && closed && std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const int error = !written ? write_error : !closed ? close_error : errno;
  ::unlink(temporary.c_str());
  throw_output_error(path, std::strerror(error));
}

}  // namespace particle_surface_tracker
