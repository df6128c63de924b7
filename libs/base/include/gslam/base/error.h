#ifndef GSLAM_BASE_ERROR_H
#define GSLAM_BASE_ERROR_H

#include <gslam/base/platform.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

/// @file
/// The exceptions of GSLAM.
///
/// What comes from outside (files, arguments, plugins, sizes) and is wrong is thrown as one of
/// these. Numeric failure (no solution, not converged) is a returned result, never an exception.

namespace gslam {
inline namespace v1 {

/// Base of every exception that GSLAM throws on purpose; `what()` is a sentence for people.
class GSLAM_PUBLIC Error : public std::runtime_error {
 public:
  /// @param message  a sentence: what was wrong and what was expected
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// An argument that can never be right, such as a negative size or an unknown name.
class GSLAM_PUBLIC ArgumentError : public Error {
 public:
  /// @param argument  name of the argument as the caller wrote it, e.g. "--fps"
  /// @param problem   what was wrong and what was expected, e.g. "is -3, expected 1 or more"
  ArgumentError(const std::string& argument, const std::string& problem)
      : Error(argument + " " + problem), argument_(std::make_shared<std::string>(argument)) {}

  /// Name of the argument.
  const std::string& argument() const noexcept { return *argument_; }

 private:
  std::shared_ptr<const std::string> argument_;  // shared, so that copying never throws
};

/// A file or folder that cannot be opened, read or written.
class GSLAM_PUBLIC FileError : public Error {
 public:
  /// @param path     the file or folder
  /// @param problem  what was wrong and what was expected, e.g. "is empty"
  FileError(const std::string& path, const std::string& problem)
      : Error(path + ": " + problem), path_(std::make_shared<std::string>(path)) {}

  /// Adds the operating system's reason.
  /// @param path          the file or folder
  /// @param problem       what failed, e.g. "cannot be opened"
  /// @param error_number  `errno` as it was right after the failed call
  FileError(const std::string& path, const std::string& problem, int error_number)
      : FileError(path, problem + ": " + std::generic_category().message(error_number)) {}

  /// The file or folder.
  const std::string& path() const noexcept { return *path_; }

 private:
  std::shared_ptr<const std::string> path_;
};

/// Text or data that breaks the rules of its format at a known place.
class GSLAM_PUBLIC ParseError : public Error {
 public:
  /// The message reads `source:line:column: problem`, as compilers print it.
  /// @param source   file name, or what stands for it, e.g. "command line"
  /// @param line     from 1; 0 where the format has no lines
  /// @param column   from 1, in bytes; 0 where unknown
  /// @param problem  what was found and what was expected
  ParseError(const std::string& source, std::size_t line, std::size_t column,
             const std::string& problem)
      : Error(place(source, line, column) + ": " + problem),
        source_(std::make_shared<std::string>(source)),
        line_(line),
        column_(column) {}

  /// @{
  /// The place, as given to the constructor.
  const std::string& source() const noexcept { return *source_; }
  std::size_t line() const noexcept { return line_; }
  std::size_t column() const noexcept { return column_; }
  /// @}

 private:
  static std::string place(const std::string& source, std::size_t line, std::size_t column) {
    std::string text = source;
    if (line != 0) text += ":" + std::to_string(line);
    if (line != 0 && column != 0) text += ":" + std::to_string(column);
    return text;
  }

  std::shared_ptr<const std::string> source_;
  std::size_t line_;
  std::size_t column_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_ERROR_H
