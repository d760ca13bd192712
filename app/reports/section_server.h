// SectionServer: the engine as a server on a pipe, with frames of JSON and numbers.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "bindings/lamella.h"

namespace lamella {

/// A reply: a line of JSON, followed by numbers (little-endian).
struct ServerReply {
    nlohmann::ordered_json head;
    std::string body;
};

/// Answers requests, one at a time. A request is an object with a `method`; docs/embedding/server.md
/// describes its other members and the replies. Mistakes in a request are reported in the reply; nothing is
/// thrown.
class SectionServer {
  public:
    SectionServer();
    ~SectionServer();
    SectionServer(const SectionServer&) = delete;
    SectionServer& operator=(const SectionServer&) = delete;

    ServerReply answer(const std::string& request);
    /// Returns true if the last request was to end.
    bool has_ended() const { return ended_; }

  private:
    using Json = nlohmann::ordered_json;
    ServerReply answer(const Json& request);
    ServerReply open(const Json& request);
    ServerReply close(const Json& request);
    ServerReply cut(const Json& request);
    ServerReply run(const Json& request);
    lamella_job* job_of(const Json& request) const;
    void check(std::int32_t status) const;

    lamella_context* context_ = nullptr;
    std::map<std::int64_t, lamella_job*> jobs_;
    std::int64_t next_job_ = 1;
    bool ended_ = false;
};

}  // namespace lamella
