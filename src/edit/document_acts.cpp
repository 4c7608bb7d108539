#include "edit/document_acts.h"

namespace knead {

namespace {

// One for each kind of line, so that none is forgotten.
struct ActOnDocument {
    Document& document;
    const std::string& place;
    Progress& progress;

    void operator()(const HandleLine& line) const { document.declare(line, place); }
    void operator()(const DragLine& line) const { document.drag(line, place, progress); }
    void operator()(const SettleLine& line) const { document.settle(line, progress); }
    void operator()(const CommitLine& /*line*/) const { document.commit(progress); }
    void operator()(const SetLine& line) const { document.change_settings(line.change, place); }
    void operator()(const DeleteLine& line) const { document.remove(line, place); }
    void operator()(const RenameLine& line) const { document.rename(line, place); }
    void operator()(const CheckLine& /*line*/) const {}
    void operator()(const UndoLine& /*line*/) const { document.undo(place); }
    void operator()(const RedoLine& /*line*/) const { document.redo(place); }
};

} // namespace

void carry_out_act(Document& document, const SessionAction& action, const std::string& place,
                   Progress& progress) {
    std::visit(ActOnDocument{document, place, progress}, action);
}

} // namespace knead
