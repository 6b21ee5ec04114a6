//! A space of budgets: a profile, and the fields that a search varies. Spec clauses `Q-1` and `Q-2`.

use super::field::{Field, FieldError, Level, Value};
use crate::profile::{InvalidProfile, Profile};

/// A field and the values it takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// The field.
    pub field: Field,
    /// Its values, in order.
    pub values: Vec<Value>,
}

/// A profile and the fields to vary. Budgets are numbered with the last axis fastest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Space {
    base: Profile,
    axes: Vec<Axis>,
    /// Whether the edge width follows the grid: the profile's own was exactly enough, and no axis
    /// sets it.
    follows: bool,
}

/// What a number of a space stands for.
#[derive(Clone, Debug)]
pub enum Point {
    /// A budget.
    Budget(Box<Profile>),
    /// Another number's budget: an axis sets a field that this one does not have.
    Again,
    /// The index is invalid: the resulting profile fails validation.
    Invalid(InvalidProfile),
}

/// An axis or a space that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SpaceError {
    /// No such field.
    #[error("{name:?} is not a field that can be varied; the fields are {known}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// Not of the form FIELD=VALUES.
    #[error(
        "{0:?}: an axis is FIELD=VALUES, for example interpolation=8..14 or rounding=floor,nearest-even"
    )]
    Syntax(String),
    /// A range that ends before it begins.
    #[error("{field}={low}..{high} is empty, because {low} > {high}; write {field}={high}..{low}")]
    Empty {
        /// The field.
        field: &'static str,
        /// Where the range begins.
        low: i64,
        /// Where it ends.
        high: i64,
    },
    /// A range of more values than any field has.
    #[error("{field}={low}..{high} has {count} values, but a field may have at most {most}", most = MOST_VALUES)]
    Long {
        /// The field.
        field: &'static str,
        /// Where the range begins.
        low: i64,
        /// Where it ends.
        high: i64,
        /// How many values that is.
        count: u64,
    },
    /// A field on two axes.
    #[error("{0} is varied twice: write all its values in one --vary")]
    Twice(&'static str),
    /// A value that the field does not take.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// More budgets than results can be kept of.
    #[error("the axes give more than 2^20 budgets: use fewer values in one axis")]
    Large,
    /// Not one of them is a budget.
    #[error("none of the {count} budgets of this space is valid; the first error: {source}")]
    Nothing {
        /// How many numbers there are.
        count: u64,
        /// Why the first is none.
        source: Box<InvalidProfile>,
    },
}

/// As many results as fit a machine's memory, and a space of which none is possible is seen to be
/// one within seconds.
const MOST_BUDGETS: u64 = 1 << 20;

/// No word is wider, so no field has more values.
const MOST_VALUES: u64 = 256;

impl Axis {
    /// Reads `FIELD=VALUES`: values and ranges joined by commas, a range written LOW..HIGH with
    /// both ends included.
    ///
    /// ```
    /// use guardbit::explore::space::Axis;
    /// assert_eq!(Axis::parse("guard=0..2,4")?.values.len(), 4);
    /// assert!(Axis::parse("guard=2..0").is_err());
    /// # Ok::<(), guardbit::explore::space::SpaceError>(())
    /// ```
    ///
    /// # Errors
    /// [`SpaceError`] says what is wrong and what would do.
    pub fn parse(text: &str) -> Result<Self, SpaceError> {
        let syntax = || SpaceError::Syntax(text.to_owned());
        let (name, list) = text.split_once('=').ok_or_else(syntax)?;
        let field = Field::find(name.trim()).ok_or_else(|| SpaceError::Unknown {
            name: name.trim().to_owned(),
            known: Field::all().iter().map(|field| field.name()).collect::<Vec<_>>().join(", ")
                + ", and those of channels, such as color.interpolation or w.integer",
        })?;
        let mut values = Vec::new();
        for part in list.split(',').map(str::trim) {
            if part.is_empty() {
                return Err(syntax());
            }
            let Some((low, high)) = part.split_once("..") else {
                values.push(field.parse(part)?);
                continue;
            };
            let end = |text: &str| match field.parse(text.trim_start_matches('=').trim())? {
                Value::Bits(bits) => Ok(i64::from(bits)),
                Value::Number(number) => Ok(number),
                Value::Name(_) => Err(syntax()),
            };
            let (low, high, name) = (end(low)?, end(high)?, field.name());
            if low > high {
                return Err(SpaceError::Empty { field: name, low, high });
            }
            let count = high.abs_diff(low).saturating_add(1);
            if count > MOST_VALUES {
                return Err(SpaceError::Long { field: name, low, high, count });
            }
            for number in low..=high {
                values.push(field.parse(&number.to_string())?);
            }
        }
        // A value named twice is one budget.
        let mut seen = Vec::with_capacity(values.len());
        values.retain(|value| {
            let new = !seen.contains(value);
            seen.push(value.clone());
            new
        });
        Ok(Self { field, values })
    }
}

impl Space {
    /// The space of a profile and axes.
    ///
    /// # Errors
    /// [`SpaceError`] for a field on two axes, or a space without a budget.
    pub fn new(base: Profile, axes: Vec<Axis>) -> Result<Self, SpaceError> {
        for (n, axis) in axes.iter().enumerate() {
            if axes[..n].iter().any(|before| before.field == axis.field) {
                return Err(SpaceError::Twice(axis.field.name()));
            }
        }
        let has = |field| axes.iter().any(|axis: &Axis| axis.field == field);
        let own = Field::EDGE_WIDTH.read(&base);
        let follows = !has(Field::EDGE_WIDTH)
            && own.is_some()
            && own == base.exact_edge_width().map(Value::Bits);
        let space = Self { base, axes, follows };
        space.fields_exist()?;
        let count = space.axes.iter().try_fold(1u64, |count, axis| {
            count.checked_mul(axis.values.len() as u64).filter(|count| *count <= MOST_BUDGETS)
        });
        let count = count.ok_or(SpaceError::Large)?;
        let mut first = None;
        for index in 0..count {
            match space.point(index)? {
                Point::Budget(_) => return Ok(space),
                Point::Invalid(error) => drop(first.get_or_insert(error)),
                Point::Again => {}
            }
        }
        // The first number sets every field that exists to its first value: a budget, or invalid.
        match first {
            Some(source) => Err(SpaceError::Nothing { count, source: Box::new(source) }),
            None => unreachable!("number 0 is not another number's budget"),
        }
    }

    /// Every axis sets a field that the profile has, in one of the forms that are searched.
    fn fields_exist(&self) -> Result<(), FieldError> {
        let forms = self.axes.iter().find(|axis| axis.field == Field::FORM);
        let mut bases = vec![self.base.clone()];
        for form in forms.map_or(&[][..], |axis| &axis.values) {
            let mut base = self.base.clone();
            Field::FORM.write(&mut base, form)?;
            bases.push(base);
        }
        for Axis { field, values } in &self.axes {
            let mut tried = bases.iter().map(|base| field.write(&mut base.clone(), &values[0]));
            let absent =
                |result: Result<(), FieldError>| matches!(result, Err(FieldError::Absent(_)));
            if tried.all(absent) {
                return Err(FieldError::Absent(field.name()));
            }
        }
        Ok(())
    }

    /// The profile that is varied.
    pub fn base(&self) -> &Profile {
        &self.base
    }

    /// The axes.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// A profile with another value in one field; an edge width that follows the grid follows it.
    ///
    /// # Errors
    /// [`FieldError`] for a value that the field does not take.
    pub fn with(
        &self,
        profile: &Profile,
        field: Field,
        value: &Value,
    ) -> Result<Profile, FieldError> {
        let mut changed = profile.clone();
        field.write(&mut changed, value)?;
        if self.follows {
            let _ = Field::EDGE_WIDTH.write(&mut changed, &Value::Name("exact"));
        }
        Ok(changed)
    }

    /// How many numbers the space has.
    pub fn len(&self) -> u64 {
        self.axes.iter().map(|axis| axis.values.len() as u64).product()
    }

    /// Whether the space has no number: never, once it is made.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Which value of each axis a number stands for.
    pub fn choices(&self, index: u64) -> Vec<usize> {
        let mut rest = index;
        let mut choices: Vec<usize> = self
            .axes
            .iter()
            .rev()
            .map(|axis| {
                let count = axis.values.len() as u64;
                let choice = usize::try_from(rest % count).unwrap_or(0);
                rest /= count;
                choice
            })
            .collect();
        choices.reverse();
        choices
    }

    /// The number of these values.
    pub fn index(&self, choices: &[usize]) -> u64 {
        let axes = self.axes.iter().zip(choices);
        axes.fold(0, |index, (axis, choice)| index * axis.values.len() as u64 + *choice as u64)
    }

    /// The budget of a number.
    ///
    /// # Errors
    /// [`FieldError`] for a value that its field does not take.
    pub fn point(&self, index: u64) -> Result<Point, FieldError> {
        let choices = self.choices(index);
        let mut profile = self.base.clone();
        let mut order: Vec<usize> = (0..self.axes.len()).collect();
        // Whether a field exists can depend on the form: that one is set first.
        order.sort_by_key(|axis| self.axes[*axis].field != Field::FORM);
        let mut late = None;
        for axis in order {
            let (Axis { field, values }, choice) = (&self.axes[axis], choices[axis]);
            if (*field, &values[choice]) == (Field::EDGE_WIDTH, &Value::Name("exact")) {
                late = Some(&values[choice]);
                continue;
            }
            match field.write(&mut profile, &values[choice]) {
                Ok(()) => {}
                Err(FieldError::Absent(_)) if choice == 0 => {}
                Err(FieldError::Absent(_)) => return Ok(Point::Again),
                Err(error) => return Err(error),
            }
        }
        // A width that follows the grid has to wait for it.
        if late.is_some() || self.follows {
            let _ = Field::EDGE_WIDTH.write(&mut profile, &Value::Name("exact"));
        }
        Ok(match profile.validate() {
            Ok(()) => Point::Budget(Box::new(profile)),
            Err(error) => Point::Invalid(error),
        })
    }

    /// The numbers that share everything up to a level, group by group: each group a start, whose
    /// later levels all have their first value, in the order of the axes.
    pub fn groups(&self, level: Level) -> Vec<u64> {
        self.spread(0, |of| of <= level)
    }

    /// The numbers of a group, itself first: those that differ from it in later levels alone, up
    /// to `until`.
    pub fn members(&self, group: u64, after: Level, until: Level) -> Vec<u64> {
        self.spread(group, |of| after < of && of <= until)
    }

    /// The numbers that differ from `start`, whose values are first ones there, in fields of some
    /// levels.
    fn spread(&self, start: u64, varies: impl Fn(Level) -> bool) -> Vec<u64> {
        let mut numbers = vec![start];
        let mut stride = self.len();
        for axis in &self.axes {
            let count = axis.values.len() as u64;
            stride /= count;
            if varies(axis.field.level()) {
                numbers = numbers
                    .into_iter()
                    .flat_map(|start| (0..count).map(move |n| start + n * stride))
                    .collect();
            }
        }
        numbers
    }
}

/// What a budget is made of, by name: its fields, and the bits of its words.
pub fn describe(profile: &Profile) -> Vec<(&'static str, Value)> {
    let fields = Field::of_profile(profile);
    let fields = fields.iter().filter_map(|field| Some((field.name(), field.read(profile)?)));
    let edge = match Field::EDGE_WIDTH.read(profile) {
        Some(Value::Bits(bits)) => Some(bits),
        _ => sum(profile, [Field::WALK_GUARD, Field::WALK_INTEGER, Field::WALK_FRACTION]),
    };
    let depth = sum(profile, [Field::GUARD, Field::INTEGER, Field::INTERPOLATION]);
    let words = [("edge-bits", edge), ("depth-bits", depth)];
    fields
        .chain(words.into_iter().filter_map(|(name, bits)| Some((name, Value::Bits(bits?)))))
        .collect()
}

fn sum(profile: &Profile, fields: [Field; 3]) -> Option<u32> {
    fields.into_iter().try_fold(0, |sum, field| match field.read(profile)? {
        Value::Bits(bits) => Some(sum + bits),
        Value::Number(_) | Value::Name(_) => None,
    })
}
