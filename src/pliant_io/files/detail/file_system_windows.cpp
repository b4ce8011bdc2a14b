// A file or folder is locked by what its handle does not share: nobody else gets one that writes to it. By its name it
// may still be renamed and removed.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <windows.h>
// after windows.h
#include <fcntl.h>
#include <io.h>

#include "pliant_io/files/detail/file_system.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

/// As the number that other systems have for it, so that messages are the same.
std::error_code last_error() {
  const std::error_code error(static_cast<int>(GetLastError()), std::system_category());
  const std::error_condition condition = error.default_error_condition();
  const bool is_known = condition.category() == std::generic_category();
  return is_known ? std::error_code(condition.value(), std::generic_category()) : error;
}

std::intptr_t number_of(HANDLE handle) {
  return reinterpret_cast<std::intptr_t>(handle);  // NOLINT: what a handle is
}

HANDLE handle_of(std::intptr_t number) {
  return reinterpret_cast<HANDLE>(number);  // NOLINT: what a handle is
}

HANDLE handle_of(std::FILE* file) {
  return handle_of(_get_osfhandle(_fileno(file)));
}

/// A regular file, and no link.
bool is_plain_file(HANDLE handle) {
  BY_HANDLE_FILE_INFORMATION info = {};
  constexpr DWORD others = FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_REPARSE_POINT;
  return GetFileType(handle) == FILE_TYPE_DISK && GetFileInformationByHandle(handle, &info) != 0 &&
         (info.dwFileAttributes & others) == 0;
}

bool remove_open(HANDLE handle) {
  FILE_DISPOSITION_INFO removal = {TRUE};
  return SetFileInformationByHandle(handle, FileDispositionInfo, &removal, sizeof(removal)) != 0;
}

std::error_code renamed(const fs::path& from, const fs::path& to) {
  const DWORD flags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
  return MoveFileExW(from.c_str(), to.c_str(), flags) != 0 ? std::error_code() : last_error();
}

}  // namespace

std::error_code InputFile::open(const fs::path& path) {
  close();
  HANDLE handle = CreateFileW(path.c_str(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                              nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return last_error();
  handle_ = number_of(handle);
  LARGE_INTEGER size = {};
  const bool is_regular = GetFileType(handle) == FILE_TYPE_DISK && GetFileSizeEx(handle, &size) != 0;
  size_ = is_regular ? static_cast<std::uint64_t>(size.QuadPart) : 0;
  if (is_regular) return {};
  close();
  return std::make_error_code(std::errc::not_supported);
}

std::size_t InputFile::read(std::uint64_t offset, char* into, std::size_t count, std::error_code& error) const {
  OVERLAPPED place = {};
  place.Offset = static_cast<DWORD>(offset);
  place.OffsetHigh = static_cast<DWORD>(offset >> 32U);
  constexpr std::size_t most = std::size_t{1} << 30U;  // a call takes fewer than 2^32
  DWORD done = 0;
  const bool is_read =
      ReadFile(handle_of(handle_), into, static_cast<DWORD>(std::min(count, most)), &done, &place) != 0;
  error = is_read || GetLastError() == ERROR_HANDLE_EOF ? std::error_code() : last_error();
  return error ? 0 : done;
}

void InputFile::close() {
  if (is_open()) CloseHandle(handle_of(std::exchange(handle_, none)));
}

std::FILE* open_stream(const fs::path& path, const char* mode) {
  const std::wstring wide(mode, mode + std::strlen(mode));
  return _wfopen(path.c_str(), wide.c_str());
}

std::error_code create_locked_file(const fs::path& path, std::FILE*& file) {
  HANDLE handle = CreateFileW(path.c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr,
                              CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return last_error();
  const int descriptor = _open_osfhandle(number_of(handle), _O_WRONLY | _O_BINARY);
  file = descriptor < 0 ? nullptr : _fdopen(descriptor, "wb");
  if (file != nullptr) return {};
  remove_open(handle);
  if (descriptor < 0) CloseHandle(handle);
  if (descriptor >= 0) _close(descriptor);  // and with it the handle
  return std::make_error_code(std::errc::too_many_files_open);
}

void close_and_remove(std::FILE* file, const fs::path& /*path*/) {
  remove_open(handle_of(file));
  std::fclose(file);
}

std::error_code close_and_rename(std::FILE* file, const fs::path& from, const fs::path& to) {
  // A loss of power might keep the name and lose the bytes.
  std::error_code error;
  if (FlushFileBuffers(handle_of(file)) == 0) error = last_error();
  if (!error) error = renamed(from, to);
  if (error) remove_open(handle_of(file));
  if (std::fclose(file) != 0 && !error) error = {errno, std::generic_category()};
  return error;
}

bool remove_unlocked_file(const fs::path& path) {
  HANDLE handle = CreateFileW(path.c_str(), DELETE | FILE_READ_ATTRIBUTES, 0, nullptr, OPEN_EXISTING,
                              FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return false;
  const bool is_removed = is_plain_file(handle) && remove_open(handle);
  CloseHandle(handle);
  return is_removed;
}

bool LockedFolder::lock(const fs::path& folder) {
  release();
  HANDLE handle =
      CreateFileW(folder.c_str(), FILE_ADD_FILE | FILE_READ_ATTRIBUTES, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr,
                  OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);

  if (handle == INVALID_HANDLE_VALUE) return false;
  BY_HANDLE_FILE_INFORMATION info = {};
  constexpr DWORD looked_at = FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_REPARSE_POINT;
  if (GetFileInformationByHandle(handle, &info) == 0 ||
      (info.dwFileAttributes & looked_at) != FILE_ATTRIBUTE_DIRECTORY) {
    CloseHandle(handle);
    return false;
  }
  folder_ = folder;
  handle_ = number_of(handle);
  return true;
}

std::error_code LockedFolder::rename(const fs::path& to) {
  const std::error_code error = renamed(folder_, to);
  if (!error) release();
  return error;
}

void LockedFolder::remove() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  release();
}

void LockedFolder::release() {
  if (is_locked()) CloseHandle(handle_of(std::exchange(handle_, none)));
}

}  // namespace pliant
