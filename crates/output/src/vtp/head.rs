//! The XML head of a `.vtp` file: written, and read back.

use std::fmt::Write as _;

use crate::Frame;

/// The kinds of number in our files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Float64,
    Float32,
    Int64,
    Int32,
}

impl Kind {
    const ALL: [Self; 4] = [Self::Float64, Self::Float32, Self::Int64, Self::Int32];

    /// As VTK calls it.
    fn name(self) -> &'static str {
        match self {
            Self::Float64 => "Float64",
            Self::Float32 => "Float32",
            Self::Int64 => "Int64",
            Self::Int32 => "Int32",
        }
    }

    /// Bytes per number.
    pub(super) fn size(self) -> u64 {
        match self {
            Self::Float64 | Self::Int64 => 8,
            Self::Float32 | Self::Int32 => 4,
        }
    }
}

/// An array as the head describes it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Element {
    pub(super) kind: Kind,
    pub(super) name: String,
    pub(super) unit: Option<String>,
    pub(super) components: usize,
    /// Where its numbers begin in the binary section, bytes.
    pub(super) offset: u64,
}

impl Element {
    fn text(&self) -> String {
        let Self { kind, name, unit, components, offset } = self;
        let mut text = format!(
            r#"<DataArray type="{}" Name="{}" NumberOfComponents="{components}" format="appended" offset="{offset}""#,
            kind.name(),
            escape(name)
        );
        let _ = match unit {
            None => writeln!(text, "/>"),
            Some(unit) => writeln!(
                text,
                "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey></DataArray>",
                escape(unit)
            ),
        };
        text
    }
}

/// The head of a file with these arrays: positions, cells (connectivity and offsets), quantities. The binary section follows it.
pub(super) fn text<'a>(frame: &Frame, mut elements: impl Iterator<Item = &'a Element>) -> String {
    let mut some = |count: usize| elements.by_ref().take(count).map(Element::text).collect::<String>();
    let (points, verts, quantities) = (some(1), some(2), some(usize::MAX));
    let (time, step, n) = (frame.time, frame.step, frame.points.len());
    format!(
        r#"<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
<PolyData>
<FieldData>
<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{time:?}</DataArray>
<DataArray type="Int64" Name="Step" NumberOfTuples="1" format="ascii">{step}</DataArray>
</FieldData>
<Piece NumberOfPoints="{n}" NumberOfVerts="{n}" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
<Points>
{points}</Points>
<Verts>
{verts}</Verts>
<PointData>
{quantities}</PointData>
</Piece>
</PolyData>
<AppendedData encoding="raw">
_"#
    )
}

/// `text` as it may stand in XML; control characters, which XML forbids, become spaces.
fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

/// What the head of a file says.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Head {
    pub(super) time: f64,
    pub(super) step: u64,
    pub(super) particles: u64,
    pub(super) points: Element,
    pub(super) arrays: Vec<Element>,
    /// Whether numbers are in zlib blocks.
    pub(super) compressed: bool,
}

/// More elements than a head has.
const MOST_NODES: u32 = 10_000;

impl Head {
    /// Reads the text before the binary section.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let whole = format!("{text}</AppendedData></VTKFile>");
        let options = roxmltree::ParsingOptions { nodes_limit: MOST_NODES, ..Default::default() };
        let document = roxmltree::Document::parse_with_options(&whole, options)
            .map_err(|cause| format!("its head is damaged: {cause}"))?;
        let root = document.root_element();
        let says = |name: &str, value: &str| root.attribute(name) == Some(value);
        if !(root.has_tag_name("VTKFile")
            && says("type", "PolyData")
            && says("byte_order", "LittleEndian")
            && says("header_type", "UInt64"))
        {
            return Err("it is no .vtp file of Taut: VTKFile, PolyData, little endian, UInt64".to_string());
        }
        let compressed = match root.attribute("compressor") {
            None => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                return Err(format!("its numbers are compressed by {other}, which Taut does not read"));
            }
        };
        let piece = child(root, "PolyData").and_then(|data| child(data, "Piece")).ok_or("it has no piece")?;
        let points = child(piece, "Points").and_then(|points| child(points, "DataArray"));
        let data = child(piece, "PointData").ok_or("it has no quantities")?;
        let arrays = data.children().filter(|node| node.has_tag_name("DataArray")).map(element);
        Ok(Self {
            time: field(root, "TimeValue").filter(|time: &f64| time.is_finite()).ok_or("it has no time")?,
            step: field(root, "Step").unwrap_or(0),
            particles: attribute(piece, "NumberOfPoints")?,
            points: element(points.ok_or("it has no positions")?)?,
            arrays: arrays.collect::<Result<_, _>>()?,
            compressed,
        })
    }
}

type Node<'a, 'b> = roxmltree::Node<'a, 'b>;

fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|child| child.has_tag_name(name))
}

fn attribute<T: std::str::FromStr>(node: Node, name: &str) -> Result<T, String> {
    let text = node.attribute(name).and_then(|text| text.parse().ok());
    text.ok_or_else(|| format!("{} has no usable {name}", node.tag_name().name()))
}

/// The number in a field of the whole data set.
fn field<T: std::str::FromStr>(root: Node, name: &str) -> Option<T> {
    let fields = child(root, "PolyData").and_then(|data| child(data, "FieldData"))?;
    fields.children().find(|node| node.attribute("Name") == Some(name))?.text()?.trim().parse().ok()
}

fn element(node: Node) -> Result<Element, String> {
    let name: String = attribute(node, "Name")?;
    let kind = Kind::ALL.into_iter().find(|kind| node.attribute("type") == Some(kind.name()));
    let label = |node: &Node| node.attribute("name") == Some("UNITS_LABEL");
    let unit = node.children().find(label).and_then(|node| node.text()).map(str::to_string);
    let components: usize = attribute(node, "NumberOfComponents")?;
    if !(1..=9).contains(&components) || node.attribute("format") != Some("appended") {
        return Err(format!("{name} is no array as Taut writes them"));
    }
    let kind = kind.ok_or_else(|| format!("{name} has numbers of an unknown kind"))?;
    Ok(Element { kind, name, unit, components, offset: attribute(node, "offset")? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped() {
        assert_eq!(escape("a<\"b\">&\nc"), "a&lt;&quot;b&quot;&gt;&amp; c");
    }

    #[test]
    fn what_is_written_is_read() {
        let frame = Frame { time: 0.1 + 0.2, step: 12, points: vec![[0.0; 3]; 5], arrays: vec![] };
        let element = |name: &str, unit: Option<&str>, components, offset| Element {
            kind: Kind::Float32,
            name: name.to_string(),
            unit: unit.map(str::to_string),
            components,
            offset,
        };
        let all = [
            element("Points", None, 3, 0),
            element("connectivity", None, 1, 7),
            element("offsets", None, 1, 8),
            element("a < b", Some("1 & \"2\""), 9, 1 << 40),
        ];
        let text = text(&frame, all.iter());
        let head = Head::parse(text.strip_suffix('_').unwrap()).unwrap();
        assert_eq!((head.time, head.step, head.particles, head.compressed), (0.1 + 0.2, 12, 5, true));
        assert_eq!((&head.points, &head.arrays[..]), (&all[0], &all[3..]));
    }
}
