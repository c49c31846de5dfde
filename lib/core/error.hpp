#pragma once

#include <stdexcept>
#include <string>

namespace esi {

/// The one exception of the library. Its text is a sentence that says what is wrong, where, and what to do.
class Error : public std::runtime_error {
 public:
  enum class Kind {
    failure,  ///< it could not be done: I/O, format, memory (a tool exits with 1)
    usage,    ///< wrong option or configuration, found before anything was written (2)
  };

  explicit Error(const std::string& what, Kind kind = Kind::failure)
      : std::runtime_error(what), kind_(kind) {}

  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// An Error about an option or a configuration.
inline Error usage_error(const std::string& what) { return Error(what, Error::Kind::usage); }

}  // namespace esi
