// A plugin of clang-tidy that keeps its checks away from what system headers declare. Findings there are never shown,
// but looking for them takes most of the time: a test includes a thousand times as much from the system as it holds.
#include <vector>

#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>

namespace {

namespace tidy = clang::tidy;
namespace matchers = clang::ast_matchers;

/// Finds nothing itself. Its matcher fires at the root, before anything below is visited by any check.
class OwnCodeOnly : public tidy::ClangTidyCheck {
 public:
  using ClangTidyCheck::ClangTidyCheck;

  void registerMatchers(matchers::MatchFinder* finder) override {
    finder->addMatcher(matchers::translationUnitDecl().bind("all"), this);
  }

  void check(const matchers::MatchFinder::MatchResult& result) override {
    const clang::SourceManager& sources = *result.SourceManager;
    std::vector<clang::Decl*> own;
    for (clang::Decl* declaration : result.Nodes.getNodeAs<clang::TranslationUnitDecl>("all")->decls()) {
      const clang::SourceLocation place = sources.getExpansionLoc(declaration->getLocation());
      if (place.isValid() && !sources.isInSystemHeader(place)) own.push_back(declaration);
    }
    result.Context->setTraversalScope(own);
  }
};

class OwnCodeModule : public tidy::ClangTidyModule {
 public:
  void addCheckFactories(tidy::ClangTidyCheckFactories& factories) override {
    factories.registerCheck<OwnCodeOnly>("own-code-only");
  }
};

const tidy::ClangTidyModuleRegistry::Add<OwnCodeModule> registration("own-code", "Leaves out system headers.");

}  // namespace
