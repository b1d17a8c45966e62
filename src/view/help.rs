//! State of the help window, and of lists that are searched.

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PickState {
    pub text: String,
    /// The highlighted line, counted among those that can be chosen; none for the one that is set.
    pub picked: Option<usize>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HelpView {
    /// Name of the open page; none while the window is closed.
    pub page: Option<&'static str>,
    pub visited: Vec<&'static str>,
    pub query: String,
    pub picked: usize,
    pub scroll_to: Option<usize>,
    /// True if the search field takes the keyboard in the next frame.
    pub focus_search: bool,
}

impl HelpView {
    pub fn open(&mut self, page: &'static str, block: usize) {
        if let Some(last) = self.page.replace(page).filter(|last| *last != page) {
            self.visited.push(last);
        }
        self.scroll_to = Some(block);
    }

    pub fn back(&mut self) {
        if let Some(page) = self.visited.pop() {
            (self.page, self.scroll_to) = (Some(page), Some(0));
        }
    }

    /// Clears the search, or else closes the window; returns whether there was anything to do.
    pub fn escape(&mut self) -> bool {
        if self.page.is_some() && !self.query.is_empty() {
            self.query.clear();
            return true;
        }
        self.visited.clear();
        self.page.take().is_some()
    }
}
