// One message for each error, whatever its exception type.
#include "app/console/error_report.h"

#include <cstdio>
#include <exception>
#include <new>

#include "app/console/text_output.h"
#include "engine/base/error.h"

namespace lamella {

int report_error(const std::string& message, int code) {
    std::string lines = message;
    for (std::size_t at = 0; (at = lines.find('\n', at)) != std::string::npos;)
        lines.insert(++at, "lamella: ");
    std::fputs(("lamella: " + lines + "\n").c_str(), stderr);
    return code;
}

int report_exception() {
    constexpr int fault = 3;
    try {
        throw;
    } catch (const ReaderGone& gone) {
        return gone.exit_code();
    } catch (const Error& error) {
        return report_error(error.what(), error.exit_code());
    } catch (const std::bad_alloc&) {
        return report_error("out of memory", fault);
    } catch (const std::exception& error) {
        return report_error(std::string("unexpected fault: ") + error.what(), fault);
    }
}

}  // namespace lamella
