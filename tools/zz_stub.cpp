#include "batch_page.h"
#include "thumbnail.h"
namespace spa::tools { void write_batch_page(std::ostream& out, const nlohmann::ordered_json& report, const std::function<std::string(std::size_t)>&){ out << report.dump(); } Picture thumbnail(const SphericalMap&, std::uint32_t size){ return Picture(size,size,{1,2,3}); } }
