#include "file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "file_descriptor.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

[[noreturn]] void throw_input_error(const std::string& path, const char* reason) {
  throw InputError(fmt::format("Cannot read '{}': {}.", path, reason));
}

[[noreturn]] void throw_output_error(const std::string& path, const char* reason) {
  throw OutputError(fmt::format(
      "Cannot write '{}': {}. Check that its folder is there and writable and the disk not full.", path, reason));
}

/// Renaming onto a device would replace the device by a file.
void check_replaceable(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    throw_output_error(path, S_ISDIR(status.st_mode) ? std::strerror(EISDIR) : "it is not a regular file");
  }
}

/// \param durably flushes the file before it gets its name.
void write_and_rename(const std::string& path, std::string_view bytes, bool durably) {
  check_replaceable(path);
  const std::string temporary = path + ".part";
  FileDescriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!file.is_open()) throw_output_error(path, std::strerror(errno));
  const bool written = write_all(file.number(), bytes) && (!durably || ::fsync(file.number()) == 0);
  const int write_error = errno;
  // Some file systems report a full disk only when the file is closed.
  const bool closed = file.close();
  const int close_error = errno;
  if (written && closed && std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const int error = !written ? write_error : !closed ? close_error : errno;
  ::unlink(temporary.c_str());
  throw_output_error(path, std::strerror(error));
}

/// Flushes the names in a folder.
void flush_folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  FileDescriptor opened(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Some file systems cannot flush folders, and say so with EINVAL.
  if (!opened.is_open() || (::fsync(opened.number()) != 0 && errno != EINVAL)) {
    throw_output_error(path, std::strerror(errno));
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
  write_and_rename(path, bytes, /*durably*/ false);
}

void write_file_durably(const std::string& path, std::string_view bytes) {
  write_and_rename(path, bytes, /*durably*/ true);
  flush_folder_of(path);
}

}  // namespace particle_surface_tracker
