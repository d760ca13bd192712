// Looking into messages.
#pragma once

#include <catch2/catch.hpp>
#include <string>

namespace lamella {

/// Whether a message holds a part; shows the message when a check of that fails.
inline bool mentions(const std::string& text, const std::string& part) {
    UNSCOPED_INFO(text);
    return text.find(part) != std::string::npos;
}

}  // namespace lamella
