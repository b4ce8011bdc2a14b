// A file or folder is locked by what its handle does not share: nobody else gets a handle that may remove it.
#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <utility>
#include <vector>

#include <windows.h>
// after windows.h
#include <fcntl.h>
#include <io.h>

#include "pliant_io/files/detail/file_system.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

std::error_code last_error() {
  const DWORD error = GetLastError();
  if (error == ERROR_FILE_EXISTS || error == ERROR_ALREADY_EXISTS) return std::make_error_code(std::errc::file_exists);
  return {static_cast<int>(error), std::system_category()};
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

/// By its handle, so that the lock holds until it has the name.
std::error_code rename_open(HANDLE handle, const fs::path& to) {
  const std::wstring name = fs::absolute(to).wstring();
  const std::size_t bytes = name.size() * sizeof(wchar_t);
  std::vector<std::max_align_t> room(1 + (sizeof(FILE_RENAME_INFO) + bytes) / sizeof(std::max_align_t));
  auto* info = reinterpret_cast<FILE_RENAME_INFO*>(room.data());  // NOLINT: as the system wants it
  info->ReplaceIfExists = TRUE;
  info->FileNameLength = static_cast<DWORD>(bytes);
  std::copy(name.begin(), name.end(), info->FileName);
  const auto size = static_cast<DWORD>(sizeof(FILE_RENAME_INFO) + bytes);
  return SetFileInformationByHandle(handle, FileRenameInfo, info, size) != 0 ? std::error_code() : last_error();
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
  const bool is_read = ReadFile(handle_of(handle_), into, static_cast<DWORD>(std::min(count, most)), &done, &place) != 0;
  error = is_read || GetLastError() == ERROR_HANDLE_EOF ? std::error_code() : last_error();
  return error ? 0 : done;
}

void InputFile::close() {
  if (is_open()) CloseHandle(handle_of(std::exchange(handle_, none)));
}

std::error_code create_locked_file(const fs::path& path, std::FILE*& file) {
  HANDLE handle = CreateFileW(path.c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_READ, nullptr, CREATE_NEW,
                              FILE_ATTRIBUTE_NORMAL, nullptr);
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

std::error_code close_and_rename(std::FILE* file, const fs::path& /*from*/, const fs::path& to) {
  // A loss of power might keep the name and lose the bytes.
  std::error_code error;
  if (FlushFileBuffers(handle_of(file)) == 0) error = last_error();
  if (!error) error = rename_open(handle_of(file), to);
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
  HANDLE handle = CreateFileW(folder.c_str(), DELETE | FILE_READ_ATTRIBUTES, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
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
  const std::error_code error = rename_open(handle_of(handle_), to);
  if (!error) release();
  return error;
}

void LockedFolder::remove() {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder_, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
    std::error_code kept;
    fs::remove_all(entry->path(), kept);
  }
  release();  // the folder itself is removed by its name, which the lock does not allow
  fs::remove(folder_, ignored);
}

void LockedFolder::release() {
  if (is_locked()) CloseHandle(handle_of(std::exchange(handle_, none)));
}

}  // namespace pliant
