// HostError: a network host did not do as it was asked.
#pragma once

#include <string>

#include "engine/base/error.h"

namespace lamella {

/// How a request to a host failed, by what the caller may do next.
enum class HostFailure : unsigned char {
    unreachable,  ///< nothing was sent: the request may be repeated
    unanswered,   ///< sent, at least in part, and not answered: what the host did with it is unknown
    busy,         ///< the host refused for now (429, 502, 503, 504): the request may be repeated
    damaged,      ///< the host found the upload damaged (422): it may be repeated
    refused       ///< the host refused for good
};

/// The message names the host and says what happened. A key or certificate that is not accepted is an
/// InputError instead.
class HostError : public FaultError {
  public:
    HostError(HostFailure failure, const std::string& message, int status = 0)
        : FaultError(message), failure_(failure), status_(status) {}

    HostFailure failure() const { return failure_; }
    /// The HTTP status of the answer; 0 without one.
    int status() const { return status_; }

  private:
    HostFailure failure_;
    int status_;
};

}  // namespace lamella
