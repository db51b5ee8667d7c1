//! Text that is safe in HTML and SVG, and an SVG plot under construction.

/// The style of plots, for pages (light and dark) and for files of their own.
pub(super) const PLOT_STYLE: &str = include_str!("../templates/plot.css");

/// Text with the characters that mean something in markup replaced.
pub(super) fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            // No control character but these is allowed in XML.
            c if c.is_control() && !matches!(c, '\n' | '\t') => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}

/// A group of a plot, which the page's script redraws as a whole.
pub(super) fn group(class: &str, content: &str) -> String {
    format!("<g class=\"{class}\">{content}</g>\n")
}

/// A plot.
pub(super) struct Plot {
    /// Tells its ids from those of other plots.
    pub(super) id: String,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) title: String,
    pub(super) description: String,
    pub(super) content: String,
}

impl Plot {
    /// As part of a page, which has the style.
    pub(super) fn inline(&self) -> String {
        self.svg("", "")
    }

    /// As a file of its own, light and on a background.
    pub(super) fn standalone(&self) -> String {
        let Self { width, height, .. } = self;
        let style = format!(
            "<style>{}</style>\n<rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n",
            light(PLOT_STYLE)
        );
        self.svg(&format!(" width=\"{width}\" height=\"{height}\""), &style)
    }

    fn svg(&self, size: &str, head: &str) -> String {
        let Self { id, width, height, title, description, content } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" id=\"{id}\" class=\"plot\"{size} viewBox=\"0 0 {width} {height}\" \
             role=\"img\" aria-labelledby=\"{id}-title {id}-description\">\n<title id=\"{id}-title\">{}</title>\n<desc \
             id=\"{id}-description\">{}</desc>\n{head}{content}</svg>\n",
            escape(title),
            escape(description)
        )
    }
}

/// The style with the variables of its first rule put in: programs other than browsers know none.
fn light(style: &str) -> String {
    let (variables, rules) = style.split_once("}\n").unwrap_or(("", style));
    let variables = variables.trim_start_matches(".plot{").split(';').filter_map(|one| one.split_once(':'));
    variables.fold(rules.to_owned(), |rules, (name, value)| rules.replace(&format!("var({name})"), value))
}

/// A table with a caption, a header and rows of safe markup.
pub(super) fn table(caption: &str, header: &[&str], rows: &[Vec<String>]) -> String {
    let cells = |row: &[String]| -> String {
        let cell = |(i, text): (usize, &String)| match i {
            0 => format!("<th scope=\"row\">{text}</th>"),
            _ => format!("<td>{text}</td>"),
        };
        row.iter().enumerate().map(cell).collect()
    };
    let head: String = header.iter().map(|name| format!("<th scope=\"col\">{name}</th>")).collect();
    let head = if header.is_empty() { head } else { format!("<thead><tr>{head}</tr></thead>") };
    let body: String = rows.iter().map(|row| format!("<tr>{}</tr>\n", cells(row))).collect();
    format!(
        "<div class=\"wide\"><table><caption>{caption}</caption>{head}<tbody>\n{body}</tbody></table></div>\n"
    )
}

#[cfg(test)]
mod tests {
    use super::{PLOT_STYLE, escape, light};

    #[test]
    fn files_need_no_variables() {
        assert!(PLOT_STYLE.contains("fill:var(--ink)") && light(PLOT_STYLE).contains("fill:#1b1f24"));
        assert!(!light(PLOT_STYLE).contains("--"));
    }

    #[test]
    fn markup_is_disarmed() {
        assert_eq!(escape("<b a='\"'>&\u{1}"), "&lt;b a=&#39;&quot;&#39;&gt;&amp;\u{fffd}");
    }
}
