//! How the rows of a dump are written: told from its first line, and said to the reader. Spec clause `N-13`.

use crate::format::Column;

/// How a line is taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Notation {
    /// The golden form: columns joined by `_`.
    Joined,
    /// Columns with blanks between them.
    Spaced,
    /// Columns with a separator between them, in an order of their own: for each field its column, or none.
    Separated(char, Vec<Option<usize>>),
    /// One word: columns side by side, each padded to whole digits.
    Padded,
    /// One word: the bits of the columns side by side, zeros above them.
    Packed,
}

/// One column of a row: its known bits, and those that the device left unknown.
pub(super) type Word = (u128, u128);

/// A form, whether the line that told it is a header and no row, and what is said of it.
pub(super) type Told = (Notation, bool, Vec<String>);

impl Notation {
    /// The form of a dump whose first line this is.
    ///
    /// # Errors
    /// What is missing in a header.
    pub(super) fn of(line: &str, columns: &[Column]) -> Result<Told, String> {
        let separator = [',', ';'].into_iter().find(|separator| line.contains(*separator));
        let (fields, form): (Vec<&str>, _) = match separator {
            Some(separator) => {
                let order = (0..columns.len()).map(Some).collect();
                (line.split(separator).collect(), Self::Separated(separator, order))
            }
            None => (line.split_whitespace().collect(), Self::Spaced),
        };
        let fields: Vec<&str> = fields.into_iter().map(plain).collect();
        let place = |field: &&str| columns.iter().position(|column| column.name == **field);
        let digits =
            |field: &&str| field.chars().all(|c| c.is_ascii_hexdigit() || "xXzZ".contains(c));
        // Names such as `e` are also digits: a header has a name that is none, or nothing but names.
        let named = fields.iter().filter_map(place).count();
        let is_header = named > 0 && (named == fields.len() || fields.iter().any(|f| !digits(f)));
        if is_header && (separator.is_some() || fields.len() > 1) {
            return header(&fields, separator.unwrap_or(' '), columns);
        }
        if separator.is_some() {
            let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
            let said = format!("CSV without a header: its columns are {}", names.join(", "));
            return Ok((form, false, vec![said, HEXADECIMAL.to_owned()]));
        }
        if fields.len() > 1 {
            let said = "columns have blanks between them, as $fdisplay(\"%h %h\") writes them";
            return Ok((form, false, vec![said.to_owned()]));
        }
        let length = line.len();
        let padded: usize = columns.iter().map(Column::digits).sum();
        let bits: u32 = columns.iter().map(|column| column.width).sum();
        if columns.len() > 1 && !line.contains('_') && length == padded {
            let said = "each word is a row, its columns padded to whole digits, as $writememh writes a \
                        structure of pkg.sv";
            return Ok((Self::Padded, false, vec![said.to_owned()]));
        }
        if columns.len() > 1 && !line.contains('_') && length == bits.div_ceil(4) as usize {
            let said = "each word is a row, the bits of its columns side by side without padding";
            return Ok((Self::Packed, false, vec![said.to_owned()]));
        }
        Ok((Self::Joined, false, Vec::new()))
    }

    /// The words of a line, in the order of the columns, and the digits of its don't-care mask.
    ///
    /// # Errors
    /// What is wrong with the line.
    pub(super) fn words<'l>(
        &self,
        line: &'l str,
        columns: &[Column],
    ) -> Result<(Vec<Word>, Option<&'l str>), String> {
        match self {
            Self::Joined => in_order(line, &line.split('_').collect::<Vec<_>>(), columns, exact),
            Self::Spaced => {
                in_order(line, &line.split_whitespace().collect::<Vec<_>>(), columns, loose)
            }
            Self::Separated(separator, order) => {
                let fields: Vec<&str> = if *separator == ' ' {
                    line.split_whitespace().collect()
                } else {
                    line.split(*separator).map(plain).collect()
                };
                if fields.len() != order.len() {
                    return Err(format!(
                        "the row has {} columns, but {} are needed: {line:?}",
                        fields.len(),
                        order.len()
                    ));
                }
                let mut words = vec![(0, 0); columns.len()];
                for (field, place) in fields.into_iter().zip(order) {
                    if let Some(place) = *place {
                        words[place] = loose(field, &columns[place])?;
                    }
                }
                Ok((words, None))
            }
            Self::Padded => {
                let needed: usize = columns.iter().map(Column::digits).sum();
                one_word(line, needed)?;
                let mut rest = line;
                let mut next = |column: &Column| {
                    let (mine, later) =
                        rest.split_at_checked(column.digits()).unwrap_or((rest, ""));
                    rest = later;
                    exact(mine, column)
                };
                let words = columns.iter().map(&mut next).collect::<Result<_, _>>()?;
                Ok((words, None))
            }
            Self::Packed => packed(line, columns).map(|words| (words, None)),
        }
    }

    /// Whether a text at the end of a dump could be the beginning of a row.
    pub(super) fn could_begin(&self, text: &str, columns: &[Column]) -> bool {
        if *self == Self::Joined {
            return joined_beginning(text, columns);
        }
        text.chars().all(|c| c.is_ascii_hexdigit() || "xXzZ \t,;".contains(c))
    }
}

const HEXADECIMAL: &str = "all words are hexadecimal";

/// A field without quotes and blanks around it.
fn plain(field: &str) -> &str {
    field.trim().trim_matches('"').trim()
}

/// Columns by the names of a header.
fn header(fields: &[&str], separator: char, columns: &[Column]) -> Result<Told, String> {
    let place = |field: &&str| columns.iter().position(|column| column.name == **field);
    let order: Vec<Option<usize>> = fields.iter().map(place).collect();
    for (n, column) in columns.iter().enumerate() {
        match order.iter().filter(|place| **place == Some(n)).count() {
            1 => {}
            0 => return Err(format!("the header has no column {}: {fields:?}", column.name)),
            count => {
                return Err(format!("the header has the column {} {count} times", column.name));
            }
        }
    }
    let mut said =
        vec!["the columns have the names of the first line".to_owned(), HEXADECIMAL.to_owned()];
    let others = fields.iter().zip(&order).filter(|(_, place)| place.is_none());
    let others: Vec<&str> = others.map(|(field, _)| *field).collect();
    if !others.is_empty() {
        said.push(format!(
            "not compared, since the exp file has no such column: {}",
            others.join(", ")
        ));
    }
    Ok((Notation::Separated(separator, order), true, said))
}

/// Fields in the order of the columns, and a mask behind them.
fn in_order<'l>(
    line: &str,
    fields: &[&'l str],
    columns: &[Column],
    word: fn(&str, &Column) -> Result<Word, String>,
) -> Result<(Vec<Word>, Option<&'l str>), String> {
    let (found, needed) = (fields.len(), columns.len());
    if found < needed {
        return Err(format!("the row has {found} columns, but {needed} are needed: {line:?}"));
    }
    let words = fields.iter().zip(columns).map(|(field, column)| word(field, column));
    let words = words.collect::<Result<_, _>>()?;
    let mask = fields.get(needed).copied();
    // A don't-care mask: one digit for each digit of the row.
    let digits: usize = columns.iter().map(Column::digits).sum();
    if found > needed + 1 || mask.is_some_and(|mask| mask.len() != digits) {
        return Err(format!(
            "the row has more than {needed} columns, but the last column is not a don't-care mask of {digits} digits: {line:?}"
        ));
    }
    Ok((words, mask))
}

/// A fixed number of digits.
pub(super) fn exact(field: &str, column: &Column) -> Result<Word, String> {
    if field.len() != column.digits() {
        return Err(format!(
            "column {}: {field:?} has {} digits, but {} are needed",
            column.name,
            field.len(),
            column.digits()
        ));
    }
    fits(field, digits(field, &column.name)?, column)
}

/// A number of hexadecimal digits, without or with too many zeros before it, and perhaps a prefix.
fn loose(field: &str, column: &Column) -> Result<Word, String> {
    let bare = field.strip_prefix("0x").or_else(|| field.strip_prefix("0X")).unwrap_or(field);
    let most = column.digits();
    let zeros = bare.bytes().take_while(|byte| *byte == b'0').count();
    let bare = &bare[zeros.min(bare.len().saturating_sub(most))..];
    if bare.is_empty() || bare.len() > most {
        return Err(format!(
            "column {}: {field:?} has {} digits, but 1 to {most} are needed",
            column.name,
            bare.len()
        ));
    }
    fits(field, digits(bare, &column.name)?, column)
}

fn fits(field: &str, (word, unknown): Word, column: &Column) -> Result<Word, String> {
    let mask = u128::MAX >> (128 - column.width);
    if word & !mask != 0 {
        let Column { name, width, .. } = column;
        return Err(format!("column {name}: {field} has more than {width} bits"));
    }
    Ok((word, unknown & mask))
}

/// At most 32 hexadecimal digits; X and Z are unknown.
pub(super) fn digits(field: &str, column: &str) -> Result<Word, String> {
    let (mut word, mut unknown) = (0, 0);
    for character in field.chars() {
        let (digit, blank) = match character {
            'x' | 'X' | 'z' | 'Z' => (0, 15),
            _ => match character.to_digit(16) {
                Some(digit) => (u128::from(digit), 0),
                None => {
                    return Err(format!(
                        "column {column}: {character:?} is not a hexadecimal digit"
                    ));
                }
            },
        };
        word = word << 4 | digit;
        unknown = unknown << 4 | blank;
    }
    Ok((word, unknown))
}

fn one_word(line: &str, needed: usize) -> Result<(), String> {
    if line.len() == needed && line.is_ascii() {
        return Ok(());
    }
    Err(format!("the row has {} digits, but {needed} are needed: {line:?}", line.len()))
}

/// Bits side by side, from the top down.
fn packed(line: &str, columns: &[Column]) -> Result<Vec<Word>, String> {
    let bits: u32 = columns.iter().map(|column| column.width).sum();
    let needed = bits.div_ceil(4);
    one_word(line, needed as usize)?;
    let mut all = Vec::with_capacity(4 * line.len());
    for digit in line.chars() {
        let (word, unknown) = digits(digit.encode_utf8(&mut [0; 4]), "row")?;
        all.extend((0..4).rev().map(|bit| (word >> bit & 1, unknown >> bit & 1)));
    }
    let (above, mut rest) = all.split_at((4 * needed - bits) as usize);
    if above.iter().any(|(bit, _)| *bit == 1) {
        return Err(format!("the row has more than {bits} bits: {line:?}"));
    }
    let take = |column: &Column| {
        let (mine, later) = rest.split_at(column.width as usize);
        rest = later;
        mine.iter().fold((0, 0), |(word, unknown), (a, b)| (word << 1 | a, unknown << 1 | b))
    };
    Ok(columns.iter().map(take).collect())
}

/// Whether a text could be the beginning of a row of the golden form.
fn joined_beginning(text: &str, columns: &[Column]) -> bool {
    let mut rest = text;
    for column in columns {
        let digits = column.digits().min(rest.len());
        let (mine, later) = rest.split_at_checked(digits).unwrap_or((rest, ""));
        if !mine.chars().all(|c| c.is_ascii_hexdigit() || "xXzZ".contains(c)) {
            return false;
        }
        match later.strip_prefix('_') {
            Some(later) => rest = later,
            None => return later.is_empty(),
        }
    }
    false
}
